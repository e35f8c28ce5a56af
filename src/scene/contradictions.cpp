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

// Whether there is a material of that name: one of the scene's own or a preset.
bool check_name(const Scene& scene, const std::string& name, const std::string& key, Errors& errors) {
  if (find_material(scene, name) != nullptr) return true;
  std::vector<std::string> known;
  for (const Material& material : scene.materials) known.push_back(material.name);
  for (const Material& preset : material_presets()) {
    if (std::find(known.begin(), known.end(), preset.name) == known.end()) known.push_back(preset.name);
  }
  errors.push_back({{}, 0, key, fmt::format("there is no material \"{}\"", name), "expected " + one_of(known)});
  return false;
}

void check_part(const DemTerrain& dem, Errors& errors) {
  const MapBox& box = dem.box;
  if (box == MapBox{}) {
  } else if (dem.window != PixelWindow{}) {
    errors.push_back({{}, 0, "terrain.box", "is there beside a window", "expected one of them"});
  } else if (!(box.west < box.east && box.south < box.north)) {
    errors.push_back({{},
                      0,
                      "terrain.box",
                      fmt::format("from {} to {} and from {} to {} has no area", number_text(box.west),
                                  number_text(box.east), number_text(box.south), number_text(box.north)),
                      "expected west < east and south < north"});
  }
  if (dem.height_scale == 0)
    errors.push_back({{}, 0, "terrain.height_scale", "0 makes the ground flat", "expected metres for a step"});
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
  if (const auto* dem = std::get_if<DemTerrain>(&terrain.shape)) check_part(*dem, errors);
  check_name(scene, terrain.material, "terrain.material", errors);
}

// The same pixel twice, or numbers beside colours, and materials that are not there.
void check_map(const Scene& scene, Errors& errors) {
  const MaterialMap& map = scene.terrain.material_map;
  constexpr std::size_t kMostEntries = 200;
  const std::string path = "terrain.material_map.legend";
  if (map.legend.empty()) return;
  if (map.image.empty()) {
    errors.push_back({{}, 0, "terrain.material_map.image", "is empty", "expected the name of an image or raster"});
  }
  if (map.legend.size() > kMostEntries) {
    errors.push_back({{},
                      0,
                      path,
                      fmt::format("has {} entries", map.legend.size()),
                      fmt::format("expected at most {}", kMostEntries)});
  }
  for (std::size_t i = 0; i < map.legend.size(); ++i) {
    const LegendEntry& entry = map.legend[i];
    const std::string key = path + "." + entry.text();
    check_name(scene, entry.material, key, errors);
    if (entry.color != map.legend[0].color) {
      errors.push_back({{}, 0, key, "numbers and colours in one legend", "expected all of one kind"});
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (map.legend[j].pixel != entry.pixel || map.legend[j].color != entry.color) continue;
      errors.push_back({{}, 0, key, "is there twice", "expected each pixel once"});
    }
  }
}

void check_mesh_materials(const Scene& scene, Errors& errors) {
  const auto* mesh = std::get_if<MeshTerrain>(&scene.terrain.shape);
  if (mesh == nullptr || mesh->materials.empty()) return;
  const auto refuse = [&](std::string problem, std::string expected) {
    errors.push_back({{}, 0, "terrain.mesh.materials", std::move(problem), std::move(expected)});
  };
  if (!scene.terrain.material_map.legend.empty()) {
    refuse("stands beside a material map", "expected one of them");
  }
  if (mesh->materials.size() != mesh->vertices.size()) {
    return refuse(fmt::format("holds {} for {} vertices", mesh->materials.size(), mesh->vertices.size()),
                  "expected one for every vertex, or none");
  }
  for (std::size_t v = 0; v < mesh->materials.size(); ++v) {
    if (mesh->materials[v] < scene.materials.size()) continue;
    return refuse(fmt::format("vertex {} has the material {}, and the scene defines {}", v, mesh->materials[v],
                              scene.materials.size()),
                  "expected an index into Scene::materials");
  }
}

// A crust over something that is there, and that does not come back to it.
void check_layers(const Scene& scene, Errors& errors) {
  for (const Material& material : scene.materials) {
    if (material.over.empty()) continue;
    const std::string key = "materials." + material.name + ".over.material";
    if (!check_name(scene, material.over, key, errors)) continue;
    const Material* below = find_material(scene, material.over);
    for (std::size_t depth = 0; below != nullptr && !below->over.empty() && depth < scene.materials.size(); ++depth)
      below = below->name == material.name ? nullptr : find_material(scene, below->over);
    if (below == nullptr || !below->over.empty() || below->name == material.name) {
      errors.push_back({{},
                        0,
                        key,
                        fmt::format("the layers below {} lead back to it or to each other", material.name),
                        "expected layers that end at a material without one below"});
    }
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
    append(errors, contradictions(scene.bodies[i], fmt::format("bodies[{}]", i)));
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
  check_map(scene, errors);
  check_mesh_materials(scene, errors);
  check_materials(scene, errors);
  check_layers(scene, errors);
  check_bodies(scene, errors);
  for (std::size_t i = 0; i < scene.joints.size(); ++i)
    append(errors, contradictions(scene.joints[i], scene, fmt::format("joints[{}]", i)));
  return errors;
}

}  // namespace divot::scene
