#include "viewer/snapshot.h"

#include "divot/world.h"

namespace divot::viewer {

Snapshot take_snapshot(World& world) {
  return {.surface = world.surface(),
          .dirty = world.take_dirty(),
          .topology = world.take_topology(),
          .particles = world.particles(),
          .bodies = world.bodies(),
          .bombs = world.bombs(),
          .materials = world.materials(),
          .folder = world.scene().folder,
          .sinkage = [&world](std::uint32_t vertex) { return world.sinkage(vertex); },
          .time = world.time()};
}

}  // namespace divot::viewer
