#include "bench/view_scenes.h"

#include <filesystem>

namespace divot::bench {

Result<Scene> paper_scene(const std::string& scenes) {
  return load_scene((std::filesystem::path(scenes) / "paper.toml").string(), {{"bombs.0.time", "0"}});
}

Result<Scene> rolling_scene(const std::string&) {
  Scene scene;
  scene.terrain = {.shape = GridTerrain{.columns = 501, .rows = 501, .spacing = 0.15}, .material = "mud"};
  scene.bodies = {
      {.name = "ball", .shape = Sphere{0.6}, .mass = 500, .position = {}, .above_ground = true, .velocity = {6, 2, 0}}};
  return scene;
}

}  // namespace divot::bench
