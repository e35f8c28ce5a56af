#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "divot/jobs.h"
#include "laws/medium.h"
#include "settle/ground.h"
#include "state/blasts.h"
#include "state/particles.h"
#include "state/soil.h"
#include "state/surface.h"

// stage     settle: particles hand their place to the surface, soil that was thrown lands, what is still goes to sleep
// reads     particles, blasts
// writes    surface, soil, sleep counters
// parallel  no: bound by memory, one pass over the awake
// sums      volumes over a vertex's faces in their order; thrown volume over a blast's columns in order
namespace divot::settle {

/// A particle slower than this, or that moves less than this in each step, for so many steps goes to sleep.
struct Stillness {
  float speed = 0;  ///< m/s
  float step = 0;   ///< m
  std::uint16_t steps = 1;
};

/// Arrays the stage needs; they grow and stay.
struct Scratch {
  std::vector<double> lost;  ///< [particle] m^3 that vanished below it in this step
};

/// Moves the surface with its particles and keeps the books of soil. Those that go to sleep give up their elastic rest:
/// where they are is where the ground now stands.
void update(state::Particles& particles, state::Soil& soil, state::Surface& surface, std::vector<state::Blast>& blasts,
            std::span<const laws::Medium> media, const Stillness& stillness, double time, Moved& moved,
            Scratch& scratch);

}  // namespace divot::settle
