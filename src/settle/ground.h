#pragma once

#include <cstdint>
#include <vector>

#include "state/particles.h"
#include "state/region.h"
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

/// The ground that this stage moves, by follow() and bring() alone, both exact in volume.
struct Ground {
  state::Particles& particles;
  state::Soil& soil;
  state::Surface& surface;
  Moved& moved;
};

/// Soil comes to a column, m^3, or leaves it where negative: the ground there rises or falls with its particle, and the
/// column's books say so. Soil that comes is as soft as untouched ground; what was compacted below it stays as hard as
/// it was. Returns how far the ground rose, m. [O(valence)]
float bring(Ground& ground, std::uint32_t column, double volume);
/// The same where the volume that the column gains by rising, state::vertex_area(), is known. [O(1)]
float bring(Ground& ground, std::uint32_t column, double volume, double area);

}  // namespace divot::settle
