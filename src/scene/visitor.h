#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "divot/scene.h"

namespace divot::scene {

/// The numbers a key may hold.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;  ///< true: the bound itself is not in the range

  bool contains(double value) const;  ///< false for NaN and infinities
  std::string text() const;           ///< as `> 0 and <= 60`; empty for all numbers
};

constexpr Range above(double low, double high) { return {.low = low, .high = high, .low_open = true}; }
constexpr Range between(double low, double high) { return {.low = low, .high = high}; }

/// What is known of a key besides its type.
struct Key {
  const char* name;
  const char* unit = "";
  Range range = {};
  const char* meaning = "";
  bool required = false;               ///< a scene file must hold it
  const char* default_text = nullptr;  ///< for the docs, where the struct's own default does not say it
  const char* field = nullptr;         ///< the struct's name for it, where that differs
  const char* example = nullptr;       ///< for errors about a table: how to write it
};

/// Words that a key may hold.
using Names = std::span<const char* const>;

/// One of several keys of a table that exclude each other, with the keys that mean something only beside it.
struct Branch {
  const char* name;
  std::span<const char* const> companions;
  const char* example;
};

/// Keys that a later version may read. They are refused with a reason instead of as unknown.
struct Unsupported {
  std::span<const char* const> names;
  const char* problem;
  const char* expected;
};

/// Walks over the description of a scene. What one does at a key is reading it, checking it or listing it.
/// Paths are dotted, with list elements by index: `bodies[0].mass`.
class Visitor {
 public:
  virtual ~Visitor() = default;

  // One call per key. Readers write the value and leave the default where the key is missing or wrong.
  virtual void number(const Key& key, double& value) = 0;
  virtual void integer(const Key& key, std::int64_t& value) = 0;
  virtual void flag(const Key& key, bool& value) = 0;
  virtual void text(const Key& key, std::string& value) = 0;
  virtual void vector(const Key& key, Vec3d& value) = 0;
  /// A position of three numbers, or of two for one on the ground.
  virtual void place(const Key& position, const Key& above_ground, Vec3d& value, bool& above) = 0;
  /// Values that may be left out.
  virtual void maybe_number(const Key& key, std::optional<double>& value) = 0;
  virtual void maybe_vector(const Key& key, std::optional<Vec3d>& value) = 0;
  /// A number, or a list of [time, number] with ascending times.
  virtual void profile(const Key& key, Profile& value) = 0;
  virtual void option(const Key& key, Names names, std::size_t& index) = 0;
  virtual void options(const Key& key, Names names, std::vector<std::string>& values) = 0;
  /// A table from pixels to names.
  virtual void legend(const Key& key, std::vector<LegendEntry>& entries) = 0;
  virtual void policy(const Key& key, UpdatePolicy& value) = 0;
  /// What a material starts from: one of `earlier`, or a preset.
  virtual void base(const Key& key, Material& material, std::span<const Material> earlier) = 0;

  /// The branches to walk; `current` is the one the scene holds.
  virtual std::vector<std::size_t> branches(std::span<const Branch> all, std::size_t current) = 0;
  /// Elements of a list to walk; `count` are in the scene.
  virtual std::size_t list_size(const Key& key, std::size_t count) = 0;
  /// Names of the materials to walk, each after its base.
  virtual std::vector<std::string> material_names(std::span<const Material> current) = 0;
  virtual void unsupported(const Unsupported&) {}

  /// Walks the keys of a table inside the current one.
  template <class Body>
  void table(const Key& key, Body body) {
    enter_table(key, path_to(key.name));
    body();
    leave_table();
  }
  /// Walks the tables of a list inside the current one.
  template <class T, class Body>
  void list(const Key& key, std::vector<T>& items, Body body) {
    items.resize(list_size(key, items.size()));
    for (std::size_t i = 0; i < items.size(); ++i) {
      enter_item(key, i, path_to(key.name) + "[" + item_text(i) + "]");
      body(items[i]);
      leave_table();
    }
  }
  /// An integer of any width; readers keep it in the key's range, so it always fits.
  template <class T>
  void whole(const Key& key, T& value) {
    const std::int64_t before = std::in_range<std::int64_t>(value) ? static_cast<std::int64_t>(value)
                                                                   : std::numeric_limits<std::int64_t>::max();
    std::int64_t after = before;
    integer(key, after);
    if (after != before) value = static_cast<T>(after);
  }
  /// An enumeration whose values count up from 0 in the order of `names`.
  template <class Enum>
  void choice(const Key& key, Names names, Enum& value) {
    auto index = static_cast<std::size_t>(value);
    option(key, names, index);
    value = static_cast<Enum>(index);
  }

 protected:
  std::string path_to(const std::string& name) const { return path_.empty() ? name : path_ + "." + name; }
  const std::string& path() const { return path_; }

  virtual void enter_table(const Key&, const std::string& path) { push(path); }
  virtual void enter_item(const Key&, std::size_t, const std::string& path) { push(path); }
  virtual void leave_table() { pop(); }
  virtual std::string item_text(std::size_t index) const { return std::to_string(index); }

  void push(const std::string& path);
  void pop();

 private:
  std::string path_;
  std::vector<std::string> outer_;
};

/// Walks over what a scene holds, and nothing else.
class HeldVisitor : public Visitor {
 public:
  std::vector<std::size_t> branches(std::span<const Branch>, std::size_t current) override { return {current}; }
  std::size_t list_size(const Key&, std::size_t count) override { return count; }
  std::vector<std::string> material_names(std::span<const Material> current) override;
};

/// Shortest text that reads back as `value`, as 1e12 or 0.25; rounded to `digits` significant ones where given.
std::string number_text(double value, int digits = 0);

/// `"a", "b" or "c"`.
std::string one_of(std::span<const std::string> names);
std::string one_of(Names names);

/// `expected a number > 0 (kg)`; `type` with its article.
std::string expectation(const std::string& type, const Key& key);

/// The alternative T of a variant, made anew where it holds another.
template <class T, class Variant>
T& as(Variant& variant) {
  if (T* held = std::get_if<T>(&variant)) return *held;
  return variant.template emplace<T>();
}

}  // namespace divot::scene
