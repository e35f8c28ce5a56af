#pragma once

#include <cstdint>
#include <vector>

#include "divot/vec.h"

namespace divot::bench {

/// Rough ground of two triangles a square metre, before and after some of it has moved.
struct SurfaceTask {
  std::vector<std::uint32_t> triangles;  ///< [3 * face] vertices
  std::vector<Vec3> before, after;       ///< [vertex] m
  std::vector<std::uint32_t> dirty;      ///< faces with a vertex that moved: one in a hundred
  std::vector<Vec3> balls;               ///< centres of the balls that ask, m
  float radius = 0.5f;                   ///< theirs, m
};

}  // namespace divot::bench
