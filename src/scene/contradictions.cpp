#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "scene/check.h"

namespace divot::scene {
namespace {

void append(Errors& to, Errors from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

void check_time(const Scene& scene, Errors& errors) {
  constexpr double kMostSteps = 1e9;
  if (scene.dt > scene.duration) {
    errors.push_back({{},
                      0,
                      "dt",
                      fmt::format("{} s is longer than the whole run", number_text(scene.dt, 6)),
                      fmt::format("expected at most duration, which is {} s", number_text(scene.duration))});
  }
  if (scene.duration / scene.dt > kMostSteps) {
    errors.push_back({{},
                      0,
                      "dt",
                      fmt::format("{} s in steps of {} s are {} steps", number_text(scene.duration),
                                  number_text(scene.dt, 6), number_text(scene.duration / scene.dt, 3)),
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

void check_texture(const Scene& scene, const Material& material, Errors& errors) {
  if (material.texture.empty()) return;
  std::error_code ignored;
  const auto path = std::filesystem::path(scene.folder) / material.texture;
  if (std::filesystem::is_regular_file(path, ignored)) return;
  errors.push_back({{},
                    0,
                    "materials." + material.name + ".texture",
                    fmt::format("\"{}\" is not a file", material.texture),
                    "expected a PNG or JPEG picture; relative paths start at the scene's folder"});
}

bool is_color(const std::string& text) {
  return text.size() == 7 && text.front() == '#' &&
         text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
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
    check_texture(scene, material, errors);
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
  if (!m.color.empty() && !is_color(m.color)) {
    errors.push_back({{},
                      0,
                      name("color", "color"),
                      fmt::format("\"{}\" is no colour", m.color),
                      "expected red, green and blue as two hexadecimal digits each: \"#8a7a55\""});
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

}  // namespace divot::scene
