#include <atomic>
#include <functional>

#include "integration/axis.h"

namespace divot::integration {
namespace {

// One coordinate. A stage's slopes are the speed it was evaluated at and force / mass. Bound by bandwidth: each pass
// reads and writes as little as it can, and the first and last stage do the copying and adding that would be passes of
// their own.
struct Axis {
  const float *mass, *force;
  float *x0, *v0;        // at the start of the step
  float *x, *v;          // the trial, where stages are evaluated
  float *sum_x, *sum_v;  // of the stages' weighted slopes
};

// Starts the sums and sends the trial `step` from the start.
void first_stage(const Axis& a, float step, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    const float slope_x = a.v0[i], slope_v = a.force[i] / a.mass[i];
    a.sum_x[i] = slope_x, a.sum_v[i] = slope_v;
    a.x[i] = a.x0[i] + step * slope_x, a.v[i] = a.v0[i] + step * slope_v;
  }
}

// Adds twice the slopes and sends the trial `step` from the start.
void middle_stage(const Axis& a, float step, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    const float slope_x = a.v[i], slope_v = a.force[i] / a.mass[i];
    a.sum_x[i] += 2 * slope_x, a.sum_v[i] += 2 * slope_v;
    a.x[i] = a.x0[i] + step * slope_x, a.v[i] = a.v0[i] + step * slope_v;
  }
}

// Adds the last slopes and moves the start by a sixth of the sums times the step: 1 when something is no number.
int last_stage(const Axis& a, float sixth, std::size_t begin, std::size_t end) {
  int bad = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const float place = a.x0[i] + sixth * (a.sum_x[i] + a.v[i]);
    const float speed = a.v0[i] + sixth * (a.sum_v[i] + a.force[i] / a.mass[i]);
    a.x0[i] = place, a.v0[i] = speed;
    bad |= is_no_number(speed) | is_no_number(place);
  }
  return bad;
}

}  // namespace

bool rk4(const state::MotionView& m, std::span<const float> mass, double time, double h, const Forces& forces,
         Scratch& scratch, const Jobs& jobs) {
  const std::size_t count = mass.size();
  const float dt = static_cast<float>(h);
  scratch.trial.resize(count);
  scratch.sum.resize(count);
  const state::MotionView t = scratch.trial.view(), s = scratch.sum.view();
  const auto for_each_axis = [&](const ForceView& f, const auto& work) {
    const auto range = [&](std::size_t begin, std::size_t end) {
      const float* const kg = mass.data();
      work(Axis{kg, f.x.data(), m.x.data(), m.vx.data(), t.x.data(), t.vx.data(), s.x.data(), s.vx.data()}, begin, end);
      work(Axis{kg, f.y.data(), m.y.data(), m.vy.data(), t.y.data(), t.vy.data(), s.y.data(), s.vy.data()}, begin, end);
      work(Axis{kg, f.z.data(), m.z.data(), m.vz.data(), t.z.data(), t.vz.data(), s.z.data(), s.vz.data()}, begin, end);
    };
    // By reference: a copy in std::function would be an allocation.
    jobs.for_ranges(count, kGrain, std::ref(range));
  };

  const auto first = [&](const Axis& a, std::size_t begin, std::size_t end) { first_stage(a, 0.5f * dt, begin, end); };
  const auto second = [&](const Axis& a, std::size_t begin, std::size_t end) {
    middle_stage(a, 0.5f * dt, begin, end);
  };
  const auto third = [&](const Axis& a, std::size_t begin, std::size_t end) { middle_stage(a, dt, begin, end); };
  std::atomic<bool> numbers = true;
  const auto last = [&](const Axis& a, std::size_t begin, std::size_t end) {
    if (last_stage(a, dt / 6, begin, end) != 0) numbers = false;
  };
  for_each_axis(forces(m, time), first);
  for_each_axis(forces(t, time + 0.5 * h), second);
  for_each_axis(forces(t, time + 0.5 * h), third);
  for_each_axis(forces(t, time + h), last);
  return numbers;
}

}  // namespace divot::integration
