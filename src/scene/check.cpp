#include "scene/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "scene/describe.h"

namespace divot {
namespace scene {
namespace {

/// Holds every key of a scene against its range.
class Checker : public Visitor {
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
  void policy(const Key& key, UpdatePolicy& value) override {
    if (value.kind != UpdatePolicy::Kind::every) return;
    note(out_of_range(name(key) + ".every", kEvery, std::int64_t{value.steps}));
  }
  void base(const Key&, Material&, std::span<const Material>) override {}

  std::vector<std::size_t> branches(std::span<const Branch>, std::size_t current) override { return {current}; }
  std::size_t list_size(const Key&, std::size_t count) override { return count; }
  std::vector<std::string> material_names(std::span<const Material> current) override {
    std::vector<std::string> names;
    for (const Material& material : current) names.push_back(material.name);
    return names;
  }

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

void append(Errors& to, Errors from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

/// Adds what is said of keys that nothing was said of yet: a dt of 0 is not also too many steps.
void append_new(Errors& to, const Errors& from) {
  const std::size_t count = to.size();
  for (const Error& error : from) {
    const auto same = [&](const Error& other) { return other.key == error.key; };
    if (std::none_of(to.begin(), to.begin() + static_cast<std::ptrdiff_t>(count), same)) to.push_back(error);
  }
}

void check_time(const Scene& scene, Errors& errors) {
  constexpr double kMostSteps = 1e9;
  if (scene.dt > scene.duration) {
    errors.push_back({{},
                      0,
                      "dt",
                      fmt::format("{} s is longer than the whole run", number_text(scene.dt)),
                      fmt::format("expected at most duration, which is {} s", number_text(scene.duration))});
  }
  if (scene.duration / scene.dt > kMostSteps) {
    errors.push_back({{},
                      0,
                      "dt",
                      fmt::format("{} s in steps of {} s are {} steps", number_text(scene.duration),
                                  number_text(scene.dt), number_text(scene.duration / scene.dt, 3)),
                      fmt::format("expected at most {} steps", number_text(kMostSteps))});
  }
}

void check_terrain(const Scene& scene, Errors& errors) {
  const TerrainSource& terrain = scene.terrain;
  if (const auto* grid = std::get_if<GridTerrain>(&terrain.shape)) {
    const auto vertices = static_cast<std::uint64_t>(grid->columns) * static_cast<std::uint64_t>(grid->rows);
    if (grid->columns > 0 && grid->rows > 0 && vertices > terrain.max_vertices) {
      errors.push_back({{},
                        0,
                        "terrain.grid",
                        fmt::format("{} columns x {} rows are {} vertices", grid->columns, grid->rows, vertices),
                        fmt::format("expected at most terrain.max_vertices, which is {}", terrain.max_vertices)});
    }
  }
  if (const auto* dem = std::get_if<DemTerrain>(&terrain.shape); dem != nullptr && dem->path.empty()) {
    errors.push_back({{}, 0, "terrain.dem", "is empty", "expected the name of a raster file"});
  }
  // The material: one of the scene's own or a preset.
  std::vector<std::string> known;
  for (const Material& material : scene.materials) known.push_back(material.name);
  for (const Material& preset : material_presets()) {
    if (std::find(known.begin(), known.end(), preset.name) == known.end()) known.push_back(preset.name);
  }
  if (std::find(known.begin(), known.end(), terrain.material) == known.end()) {
    errors.push_back({{},
                      0,
                      "terrain.material",
                      fmt::format("there is no material \"{}\"", terrain.material),
                      "expected " + one_of(known)});
  }
}

void check_materials(const Scene& scene, Errors& errors) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& material = scene.materials[i];
    if (material.name.empty()) errors.push_back({{}, 0, "materials", "a material has no name", "expected a name"});
    for (std::size_t j = 0; j < i; ++j) {
      if (scene.materials[j].name != material.name) continue;
      errors.push_back({{}, 0, "materials." + material.name, "two materials have this name", "expected unique names"});
    }
    append(errors, contradictions(material, "materials." + material.name));
  }
}

void check_bodies(const Scene& scene, Errors& errors) {
  // Bodies without a name are told apart by their ids.
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (scene.bodies[i].name.empty() || scene.bodies[j].name != scene.bodies[i].name) continue;
      errors.push_back({{},
                        0,
                        fmt::format("bodies[{}].name", i),
                        fmt::format("bodies[{}] is called \"{}\" too", j, scene.bodies[i].name),
                        "expected a unique name"});
      break;
    }
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

Errors contradictions(const Material& m, const std::string& path) {
  Errors errors;
  const auto name = [&](const char* key, const char* field) { return path.empty() ? field : path + "." + key; };
  if (m.repulsion_exponent <= m.attraction_exponent) {
    errors.push_back({{},
                      0,
                      name("n", "repulsion_exponent"),
                      fmt::format("{} does not exceed the exponent of attraction", number_text(m.repulsion_exponent)),
                      fmt::format("expected more than {}, which is {}", name("m", "attraction_exponent"),
                                  number_text(m.attraction_exponent))});
  }
  if (m.ground && m.bekker_kc == 0 && m.bekker_kphi == 0) {
    errors.push_back({{},
                      0,
                      name("kphi", "bekker_kphi"),
                      "0 together with kc = 0 leaves the ground without stiffness",
                      "expected a number > 0, or ground = false"});
  }
  return errors;
}

Errors contradictions(const Scene& scene) {
  Errors errors;
  check_time(scene, errors);
  check_terrain(scene, errors);
  check_materials(scene, errors);
  check_bodies(scene, errors);
  return errors;
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
