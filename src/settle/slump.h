#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/id_set.h"
#include "divot/jobs.h"
#include "laws/medium.h"
#include "settle/ground.h"
#include "settle/ring_terms.h"
#include "settle/slope_patch.h"

namespace divot::settle {

/// Arrays the slump needs; they grow and stay.
struct SlumpScratch {
  core::IdSet set;                  ///< of vertices or faces, empty between uses
  std::vector<double> stands;       ///< [medium] m, height up to which it stands vertically
  std::vector<std::uint8_t> round;  ///< [restless] what there is to look at round it
  std::vector<std::uint32_t> faces, vertices, next;
  std::vector<float> excess;  ///< [vertices] m
  SlopePatch patch;
};

/// Slopes below which nothing is steep, squared: the least of all soils, with a margin for floats.
Slopes sliding_slopes(std::span<const laws::Medium> media, double gravity);

/// Ground that was disturbed and is steeper than it can rest slides, for `dt` seconds: loose soil down to its angle of
/// repose, intact soil no further than it stood before, cohesive soil until the steep part is no higher than it can
/// stand. Looks at the faces round `soil.restless` and leaves there what still moves. What a body carries, and what is
/// in motion, stays out of it, and what slides goes no higher than the undersides of `bodies`. Stable for any dt and
/// any triangles; where `dt` is too long for the triangles it is cut, and beyond eight cuts the slide is slower.
/// [O(faces that slide)]
void slump(Ground& ground, std::span<const state::Body> bodies, std::span<const laws::Medium> media, double gravity,
           double dt, SlumpScratch& scratch, const Jobs& jobs);

}  // namespace divot::settle
