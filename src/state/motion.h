#pragma once

#include <span>
#include <vector>

namespace divot::state {

/// Positions, m, and velocities, m/s, of all particles at one instant: the particles' own, or an integrator's trial.
struct MotionView {
  std::span<float> x, y, z, vx, vy, vz;
};

/// An integrator's own arrays.
struct Motion {
  std::vector<float> x, y, z, vx, vy, vz;
  void resize(std::size_t count) {
    for (auto* array : {&x, &y, &z, &vx, &vy, &vz}) array->resize(count);
  }
  MotionView view() { return {x, y, z, vx, vy, vz}; }
};

}  // namespace divot::state
