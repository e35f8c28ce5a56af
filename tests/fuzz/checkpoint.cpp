// Any bytes as a world put aside: a world that runs, or refused with a reason.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "divot/world.h"

namespace {

divot::Scene scene() {
  divot::Scene scene;
  scene.terrain.shape = divot::GridTerrain{.columns = 9, .rows = 9, .spacing = 0.25};
  scene.terrain.material = "dry_sand";
  scene.bodies = {
      {.name = "ball", .shape = divot::Sphere{0.3}, .mass = 100, .position = {0, 0, 0}, .above_ground = true},
      {.name = "box", .shape = divot::Box{{0.2, 0.2, 0.2}}, .mass = 5, .position = {0, 0, 0.6}, .above_ground = true}};
  scene.joints = {{.type = divot::JointType::spring, .first = "ball", .second = "box", .stiffness = 100}};
  scene.bombs = {{.time = 0.05, .position = {0.5, 0.5, 0}, .above_ground = true, .yield = 1e-5}};
  return scene;
}

// What tells scene and ground, which hardly anything made up would.
std::string fingerprints() {
  const auto world = divot::World::create(scene());
  return world->save().substr(0, 16);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string kStart = fingerprints();
  auto world = divot::World::restore(kStart + std::string(reinterpret_cast<const char*>(data), size), scene());
  if (!world) {
    if (world.error().empty()) std::abort();
    return 0;
  }
  for (int k = 0; k < 3; ++k) world->step();
  for (const divot::Vec3& p : world->surface().positions)
    if (!divot::is_finite(p)) std::abort();
  return 0;
}
