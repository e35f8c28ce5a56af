#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/id_set.h"
#include "divot/jobs.h"
#include "laws/medium.h"
#include "settle/flow_aside.h"
#include "settle/follow.h"
#include "settle/ground.h"
#include "settle/slump.h"
#include "state/blasts.h"
#include "state/bodies.h"
#include "state/particles.h"
#include "state/soil.h"
#include "state/surface.h"

// stage     settle: particles hand their place to the surface, soil that was thrown lands, soil flows out from under
//           bodies, what is still goes to sleep, what is too steep slides
// reads     particles, blasts, bodies
// writes    surface, soil, sleep counters
// parallel  over the awake, eight at a time; over faces and vertices of what slides
// sums      volumes over a vertex's faces in their order; thrown volume over a blast's columns in order
namespace divot::settle {

/// Arrays the stage needs; they grow and stay.
struct Scratch {
  FollowScratch follow;
  FlowScratch flow;
  core::IdSet set;  ///< of vertices, empty between uses
  SlumpScratch slump;
  std::vector<std::uint32_t> tail, merged;  ///< of lists of vertices
};

/// Moves the surface with its particles and keeps the books of soil. Those that go to sleep give up their elastic rest:
/// where they are is where the ground now stands. `particles_changed`: rows are not those of the step before.
void update(state::Particles& particles, state::Soil& soil, state::Surface& surface, std::vector<state::Blast>& blasts,
            std::span<const state::Body> bodies, std::span<const laws::Medium> media, const Stillness& stillness,
            const Step& step, bool particles_changed, Moved& moved, Scratch& scratch, const Jobs& jobs);

}  // namespace divot::settle
