#pragma once

#include "divot/world.h"
#include "geometry/bvh.h"
#include "state/blasts.h"
#include "state/region.h"
#include "state/soil.h"
#include "state/surface.h"

namespace divot::measure {

/// How far a vertex lies below the ground it started as, m.
float sinkage(const state::Surface& surface, const state::Soil& soil, std::uint32_t vertex);

/// The crater of a blast: depth at its deepest within a crater width, width from rays all round ground zero to where
/// sinkage first falls to 5 % of the depth. All zero where the ground was not marked. [O(width / spacing)]
Crater crater(const state::Blast& blast, const state::Surface& surface, const state::Soil& soil,
              const geometry::Bvh& bvh, state::RegionScratch& scratch);

/// Soil moved since the start. Displaced and deposited are integrals over the surface's triangles of how far it lies
/// below and above the original ground; compacted is the sum of the columns' books, which know nothing of the original
/// ground. [O(touched vertices)]
SoilVolume soil_volume(const state::Surface& surface, const state::Soil& soil);

}  // namespace divot::measure
