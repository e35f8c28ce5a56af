#include "scene/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/describe.h"

namespace divot {
namespace scene {
namespace {

/// Holds every key of a scene against its range.
class Checker : public HeldVisitor {
 public:
  /// `field_names`: errors name the struct's fields, not the file's keys.
  explicit Checker(bool field_names) : field_names_(field_names) {}
  Errors errors;

  void number(const Key& key, double& value) override { note(out_of_range(name(key), key, value)); }
  void integer(const Key& key, std::int64_t& value) override { note(out_of_range(name(key), key, value)); }
  void flag(const Key&, bool&) override {}
  void text(const Key&, std::string&) override {}
  void vector(const Key& key, Vec3d& value) override { note(out_of_range(name(key), key, value)); }
  void place(const Key& position, const Key&, Vec3d& value, bool&) override { vector(position, value); }
  void maybe_number(const Key& key, std::optional<double>& value) override {
    if (value) number(key, *value);
  }
  void maybe_vector(const Key& key, std::optional<Vec3d>& value) override {
    if (value) vector(key, *value);
  }
  void profile(const Key& key, Profile& value) override { note(profile_error(name(key), key, value)); }
  void option(const Key& key, Names names, std::size_t& index) override {
    if (index >= names.size())
      note(Error{{}, 0, name(key), "no value of its enumeration", "expected " + one_of(names)});
  }
  void options(const Key& key, Names names, std::vector<std::string>& values) override {
    for (const std::string& value : values) {
      if (std::find(names.begin(), names.end(), value) != names.end()) continue;
      note(Error{{}, 0, name(key), fmt::format("\"{}\" is not known", value), "expected " + one_of(names)});
    }
  }
  void legend(const Key&, std::vector<LegendEntry>&) override {}
  void policy(const Key& key, UpdatePolicy& value) override {
    if (value.kind != UpdatePolicy::Kind::every) return;
    note(out_of_range(name(key) + ".every", kEvery, std::int64_t{value.steps}));
  }
  void base(const Key&, Material&, std::span<const Material>) override {}

 private:
  std::string name(const Key& key) const {
    return path_to(field_names_ && key.field != nullptr ? key.field : key.name);
  }
  void note(std::optional<Error> error) {
    if (error) errors.push_back(std::move(*error));
  }
  bool field_names_;
};

template <class Number>
std::optional<Error> range_error(const std::string& path, const Key& key, const Number& value, const char* type,
                                 const std::string& shown) {
  if (key.range.contains(static_cast<double>(value))) return std::nullopt;
  return Error{{}, 0, path, shown + " is out of range", expectation(type, key)};
}

/// Adds what is said of keys that nothing was said of yet: a dt of 0 is not also too many steps.
void append_new(Errors& to, const Errors& from) {
  const std::size_t count = to.size();
  for (const Error& error : from) {
    const auto same = [&](const Error& other) { return other.key == error.key; };
    if (std::none_of(to.begin(), to.begin() + static_cast<std::ptrdiff_t>(count), same)) to.push_back(error);
  }
}

}  // namespace

std::optional<Error> out_of_range(const std::string& path, const Key& key, double value) {
  return range_error(path, key, value, "a number", number_text(value));
}

std::optional<Error> out_of_range(const std::string& path, const Key& key, std::int64_t value) {
  return range_error(path, key, value, "an integer", fmt::format("{}", value));
}

std::optional<Error> out_of_range(const std::string& path, const Key& key, const Vec3d& value) {
  for (const double component : {value.x, value.y, value.z}) {
    if (auto error = range_error(path, key, component, "numbers", number_text(component))) return error;
  }
  return std::nullopt;
}

std::optional<Error> profile_error(const std::string& path, const Key& key, const Profile& profile) {
  if (profile.points.empty())
    return Error{{}, 0, path, "is empty", expectation("a number or [[time, number], ...]", key)};
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    const auto [time, value] = profile.points[i];
    if (auto error = out_of_range(fmt::format("{}[{}]", path, i), key, value)) return error;
    if (!(std::abs(time) <= 1e9) || (i > 0 && !(time > profile.points[i - 1].first)))
      return Error{{},
                   0,
                   fmt::format("{}[{}]", path, i),
                   fmt::format("time {} does not come after the one before", number_text(time)),
                   "expected ascending times (s)"};
  }
  return std::nullopt;
}

}  // namespace scene

Errors check(const Material& material) {
  scene::Checker checker(true);
  Material copy = material;
  scene::describe(checker, copy);
  scene::append_new(checker.errors, scene::contradictions(material, ""));
  return std::move(checker.errors);
}

Errors check(const Scene& scene) {
  scene::Checker checker(false);
  Scene copy = scene;
  scene::describe(checker, copy);
  scene::append_new(checker.errors, scene::contradictions(scene));
  return std::move(checker.errors);
}

}  // namespace divot
