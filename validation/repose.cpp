// Loose soil at rest: no slope stays steeper than the angle of repose by more than two degrees.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "validation/craters.h"
#include "validation/families.h"
#include "validation/simulate.h"

namespace divot::validation {
namespace {

constexpr double kAllowed_deg = 2;
constexpr const char* kSource = "angle of repose";

// Steepest triangle, degrees.
double steepest(const World& world) {
  const SurfaceView ground = world.surface();
  double most = 0;
  for (std::size_t k = 0; k + 2 < ground.triangles.size(); k += 3) {
    const Vec3 a = ground.positions[ground.triangles[k]];
    const Vec3 normal =
        cross(ground.positions[ground.triangles[k + 1]] - a, ground.positions[ground.triangles[k + 2]] - a);
    most = std::max<double>(most, std::atan2(std::hypot(normal.x, normal.y), normal.z));
  }
  return most * 180 / std::numbers::pi;
}

double limit(const char* material) {
  const Material* preset = find_preset(material);
  return preset ? preset->repose_angle_deg + kAllowed_deg : std::numeric_limits<double>::quiet_NaN();
}

Experiment slope(const char* what, const char* quantity, const char* material, const Scene& scene, double until) {
  return {
      {{fmt::format("repose/{}/{}", what, material), kSource, quantity, "degrees", limit(material), 0, Bound::at_most}},
      [=]() -> Result<Outcome> {
        const auto world = run(scene, until);
        if (!world) return tl::unexpected(world.error());
        return Outcome{{steepest(*world)}};
      }};
}

Scene crater(const char* material) { return bomb_scene(material, kTon, 0, 10 * kScaledCraters[0].radius, 12); }

// The slope falls along x.
Scene crater_on_slope(const char* material, double slope_deg) {
  Scene scene = crater(material);
  const double fall = std::tan(slope_deg * std::numbers::pi / 180);
  std::get<GridTerrain>(scene.terrain.shape).height = [fall](double x, double) { return -fall * x; };
  scene.bombs.front().above_ground = true;
  return scene;
}

// A heavy ball that ploughs through and leaves a rut with berms.
Scene rut(const char* material) {
  Scene scene = flat(material, 61, 0.05);
  std::get<GridTerrain>(scene.terrain.shape).rows = 161;
  scene.bodies = {{.name = "ball",
                   .shape = Sphere{.radius = 0.5},
                   .mass = 3000,
                   .position = {0.01, -3, 0},
                   .above_ground = true,
                   .velocity = {0, 6, 0},
                   .angular_velocity = {-12, 0, 0}}};
  return scene;
}

}  // namespace

Result<std::vector<Experiment>> repose(const Places&) {
  std::vector<Experiment> experiments;
  for (const char* material : {"dry_sand", "gravel", "lunar_regolith"}) {
    experiments.push_back(slope("crater", "steepest slope of a crater of a ton", material, crater(material), 12));
    experiments.push_back(slope("rut", "steepest slope of a rut, of a ball of 3 t", material, rut(material), 6));
  }
  experiments.push_back(slope("crater_on_slope", "steepest slope of a crater of a ton on 15 degrees", "dry_sand",
                              crater_on_slope("dry_sand", 15), 12));
  return experiments;
}

}  // namespace divot::validation
