#pragma once

#include <cstdint>
#include <span>

#include "laws/medium.h"
#include "settle/settle.h"
#include "state/blasts.h"
#include "state/particles.h"
#include "state/soil.h"
#include "state/surface.h"

namespace divot::settle {

/// Soil that a blast drove down in this step: a share of it is thrown, the rest is compacted. Returns the volume
/// thrown, m^3. Call it before the surface follows its particles.
double throw_soil(const state::Blast& blast, const state::Particles& particles, const state::Surface& surface,
                  state::Soil& soil, std::span<const laws::Medium> media);

/// Spreads that volume over the ground the blast's ejecta land on.
void land_soil(const state::Blast& blast, float volume, state::Particles& particles, state::Surface& surface,
               state::Soil& soil, Moved& moved);

}  // namespace divot::settle
