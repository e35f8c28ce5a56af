#pragma once

#include <functional>
#include <span>

#include "divot/jobs.h"
#include "state/motion.h"

// stage     integration: motion by eq. 4 over one substep
// reads     mass, force (through `forces`)
// writes    position, velocity
// parallel  over particles
// sums      none
namespace divot::integration {

/// Forces, N, at a time, s, for particles that are and move as `motion` says. The spans stay valid until the next call.
struct ForceView {
  std::span<const float> x, y, z;
};
using Forces = std::function<ForceView(const state::MotionView& motion, double time)>;

/// Arrays the integrators need; they grow to the number of particles and stay.
struct Scratch {
  state::Motion trial;  ///< where stages of RK4 are evaluated
  state::Motion sum;    ///< weighted sum of the stages' slopes
};

/// Semi-implicit Euler: velocity from the force, then position from the new velocity. Order 1. False when something is
/// not finite any more.
bool euler(const state::MotionView& motion, std::span<const float> mass, double time, double h, const Forces& forces,
           const Jobs& jobs);

/// Classical Runge-Kutta of order 4: four evaluations of the forces. False likewise.
bool rk4(const state::MotionView& motion, std::span<const float> mass, double time, double h, const Forces& forces,
         Scratch& scratch, const Jobs& jobs);

}  // namespace divot::integration
