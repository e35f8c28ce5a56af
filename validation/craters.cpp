#include "validation/craters.h"

#include <cmath>

#include "validation/simulate.h"

namespace divot::validation {
namespace {

constexpr double kReach = 4;  // radii of ground around a bomb
constexpr double kRest = 4;   // s until what was thrown has landed and slopes have slid

}  // namespace

Scene bomb_scene(const std::string& material, double charge, double height, double radius, int per_radius) {
  const double spacing = radius / per_radius;
  Scene scene = flat(material, 2 * static_cast<int>(kReach * per_radius) + 1, spacing);
  // Off the vertex in the middle: bombs do not know of the mesh.
  scene.bombs = {{.position = {0.3 * spacing, 0.1 * spacing, height}, .yield = charge / kTon}};
  return scene;
}

Result<World> explode(const Scene& scene) {
  // Large craters take longer, as falling does.
  return run(scene, kRest * std::max(1.0, std::pow(scene.bombs.front().yield, 1.0 / 6)));
}

}  // namespace divot::validation
