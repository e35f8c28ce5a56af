// Any bytes as a world put aside: a world that runs, or refused with a reason.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
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
constexpr std::size_t kFingerprints = 16;

std::string fingerprints() {
  const auto world = divot::World::create(scene());
  return world->save().substr(0, kFingerprints);
}

}  // namespace

// Worlds to start from are made anew, as their bytes follow what the world is made of: while bodies fall, where they
// touch, in the blast and after it. They go into the first folder named.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const auto folder = std::find_if(*argv + 1, *argv + *argc, [](const char* a) { return a[0] != '-'; });
  if (folder == *argv + *argc || !std::filesystem::is_directory(*folder)) return 0;
  auto world = divot::World::create(scene());
  for (int step = 0; step <= 20; world->step(), ++step)
    if (step == 0 || step == 1 || step == 4 || step == 20)
      std::ofstream(std::filesystem::path(*folder) / ("after_" + std::to_string(step)), std::ios::binary)
          << world->save().substr(kFingerprints);
  return 0;
}

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
