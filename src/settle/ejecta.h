#pragma once

#include <span>

#include "settle/ground.h"
#include "state/blasts.h"

namespace divot::settle {

/// Of the soil that a blast drove down in this step a share is thrown or pushed aside (Blast::thrown); the rest stays
/// compacted. Returns the volume thrown, m^3, and takes it from `lost`: [particle] m^3 that vanished below it in this
/// step.
double throw_soil(const state::Blast& blast, const state::Particles& particles, std::span<float> lost,
                  state::Soil& soil);

/// Spreads that volume over the ground the blast's ejecta land on. Returns how far it rose at most, m.
float land_soil(const state::Blast& blast, double volume, Ground& ground);

}  // namespace divot::settle
