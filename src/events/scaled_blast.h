#pragma once

#include <span>

#include "laws/medium.h"
#include "state/blasts.h"
#include "state/region.h"
#include "state/soil.h"
#include "state/surface.h"

namespace divot::events {

/// What the cube-root scaled model needs to know of a burst.
struct Burst {
  double yield = 0;    ///< t of TNT
  double height = 0;   ///< of the charge above the ground below or above it, m; negative: buried
  double gravity = 0;  ///< m/s^2, >= 0
};

/// Fills in what the blast does: each column's own soil says how far it fails and how deep it flows, and what leaves
/// the crater lands and heaves up around it. `blast` has its ground zero and pulse. With `earlier` blasts that still
/// act it makes common craters (events/together.h).
void push_scaled(const Burst& burst, state::Blast& blast, std::span<state::Blast> earlier, state::Surface& surface,
                 state::Soil& soil, const geometry::Bvh& bvh, std::span<const laws::Medium> media,
                 state::RegionScratch& scratch);

}  // namespace divot::events
