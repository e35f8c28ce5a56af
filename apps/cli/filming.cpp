#include "cli/filming.h"

#include <fmt/format.h>

#include <cstdio>

#include "cli/interrupt.h"

namespace divot::cli {

Filming::Filming(World& world, viewer::Renderer& renderer)
    : world_(world), renderer_(renderer), progress_(world.scene().duration, true) {
  renderer_.update(world_);
}

Result<viewer::Image> Filming::picture_at(double time, bool wireframe) {
  for (const double early = time - 0.5 * world_.scene().dt; world_.time() < early && !interrupted();) {
    world_.step();
    progress_.update(world_.time());
  }
  if (interrupted()) return {};
  renderer_.set_wireframe(wireframe);
  renderer_.update(world_);
  return renderer_.pixels();
}

void Filming::say(const std::string& text) {
  progress_.clear();
  fmt::print("{}\n", text);
  std::fflush(stdout);
}

}  // namespace divot::cli
