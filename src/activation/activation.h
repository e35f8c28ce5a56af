#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/id_set.h"
#include "laws/medium.h"
#include "state/particles.h"
#include "state/soil.h"
#include "state/surface.h"

// stage     activation: which vertices are particles
// reads     surface, media, list of vertices to wake
// writes    rows of particles, columns of newly touched vertices
// parallel  no: only steps in which the set changes do any work
// sums      none; rows end up ascending by vertex
namespace divot::activation {

/// Arrays the stage needs; they grow and stay.
struct Scratch {
  core::IdSet set;  ///< of vertices, empty between uses
  std::vector<std::uint32_t> awake, anchors;
  state::Particles next;
};

/// Drops particles that have been still, wakes `wake` (any order, repeats allowed; cleared), and surrounds what is
/// awake with anchors. True if rows changed: indices of particles are then other ones.
bool update(state::Particles& particles, state::Soil& soil, state::Surface& surface,
            std::span<const laws::Medium> media, std::vector<std::uint32_t>& wake, Scratch& scratch);

}  // namespace divot::activation
