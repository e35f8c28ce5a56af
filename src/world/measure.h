#pragma once

#include <span>

#include "divot/world.h"
#include "geometry/bvh.h"
#include "laws/medium.h"
#include "state/blasts.h"
#include "state/bodies.h"
#include "state/particles.h"
#include "state/region.h"
#include "state/soil.h"
#include "state/surface.h"

namespace divot::measure {

/// How far a vertex lies below the ground it started as, m.
float sinkage(const state::Surface& surface, const state::Soil& soil, std::uint32_t vertex);

/// Pressure by which the soil holds up a vertex, Pa; 0 where no particle is awake.
float pressure(const state::Surface& surface, const state::Soil& soil, std::span<const laws::Medium> media,
               std::uint32_t vertex);

/// Mechanical energy of bodies and awake particles. `origin`: potential energy counts from the terrain's z = 0.
Energy energy(std::span<const state::Body> bodies, const state::Particles& particles, const Vec3d& gravity,
              const Vec3d& origin);

/// Height over x, y of the ground as it was before the first touch, m. Walks from `face`, as it was, to the one that
/// holds the point.
double original_height(const state::Surface& surface, const state::Soil& soil, std::uint32_t face, const Vec3d& at);

/// The crater of a blast: depth where the ground that failed lies deepest, the rest from rays all round ground zero,
/// each to where sinkage first falls to 5 % of the depth. Rays that run into another crater are left out as long as any
/// does not. All zero where the ground was not marked. [O(width / spacing)]
Crater crater(const state::Blast& blast, const state::Surface& surface, const state::Soil& soil,
              const geometry::Bvh& bvh, state::RegionScratch& scratch);

/// Soil moved since the start. Displaced and deposited are integrals over the surface's triangles of how far it lies
/// below and above the original ground; compacted is the sum of the columns' books, which know nothing of the original
/// ground. [O(touched vertices)]
SoilVolume soil_volume(const state::Surface& surface, const state::Soil& soil);

}  // namespace divot::measure
