#pragma once

#include <cstdint>
#include <vector>

#include "state/particles.h"
#include "state/soil.h"
#include "state/surface.h"

namespace divot::settle {

/// The step that has just been made.
struct Step {
  double time = 0;     ///< s, at its end
  double dt = 0;       ///< s
  double gravity = 0;  ///< m/s^2, downward
};

/// What the surface did in this step.
struct Moved {
  std::vector<std::uint32_t> vertices;  ///< that moved, ascending
  float distance = 0;                   ///< m, none went further
  float free_distance = 0;              ///< m, nor did any that no body carried
};

/// The ground that this stage moves: the only two ways in which the surface changes, both exact in volume.
struct Ground {
  state::Particles& particles;
  state::Soil& soil;
  state::Surface& surface;
  Moved& moved;
};

/// Moves a vertex of the surface to `to` and returns the volume that has vanished below it, m^3: what the faces round
/// it sweep, which is exact for any motion while the others stand still. A vertex of the border must keep its x and y.
/// [O(valence)]
double move_vertex(state::Surface& surface, std::uint32_t vertex, const Vec3& to);

/// Soil comes to a column, m^3, or leaves it where negative: the ground there rises or falls with its particle, and the
/// column's books say so. Soil that comes is as soft as untouched ground; what was compacted below it stays as hard as
/// it was. Returns how far the ground rose, m. [O(valence)]
float bring(Ground& ground, std::uint32_t column, double volume);

}  // namespace divot::settle
