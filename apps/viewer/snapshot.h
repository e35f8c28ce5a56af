#pragma once

#include <span>
#include <string>
#include <vector>

#include "divot/material.h"
#include "divot/views.h"
#include "viewer/terrain_chunk.h"

namespace divot {
class World;
}

namespace divot::viewer {

/// A world as pictures need it. Valid until the world's next step.
struct Snapshot {
  SurfaceView surface;
  std::vector<DirtyRange> dirty;  ///< ascending, disjoint: what moved since the last snapshot
  Topology topology;              ///< what became of the triangles since then
  ParticleView particles;
  std::vector<BodyView> bodies;
  std::vector<BombView> bombs;
  std::span<const Material> materials;
  std::string folder;  ///< where relative paths of their textures start
  Sinkage sinkage;     ///< empty: nothing has sunk
  double time = 0;     ///< s
};

/// Takes the world's dirty ranges with it: one snapshot for each picture. [O(bodies + bombs + ranges)]
Snapshot take_snapshot(World& world);

}  // namespace divot::viewer
