#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/scene_input.h"

namespace divot::cli {
namespace {

std::string count(std::size_t n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

}  // namespace

int check(const CheckOptions& options) {
  // Making the world reads every file that the scene names, and places what stands on the ground.
  const auto world = open_world(options.scene);
  if (!world) return report(world.error(), kBadInput);
  const Scene& scene = world->scene();
  fmt::print("{}: ok ({}, {}, {}, {})\n", options.scene.path,
             count(world->surface().triangles.size() / 3, "triangle", "triangles"),
             count(scene.bodies.size(), "body", "bodies"), count(scene.bombs.size(), "bomb", "bombs"),
             count(step_count(scene), "step", "steps"));
  return kDone;
}

}  // namespace divot::cli
