#include "integration/integrators.h"

namespace divot::integration {
namespace {

// One coordinate of one stage: adds the stage's slopes to the sums with weight w and, unless it is the last stage,
// moves the trial a further `step` from the start along them. Slopes are the trial's velocity and f / mass.
struct Axis {
  std::span<const float> x0, v0, force;
  std::span<float> x, v, sum_x, sum_v;
};

void add_stage(const Axis& a, std::span<const float> mass, float weight, float step, bool first, std::size_t begin,
               std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    const float slope_x = a.v[i], slope_v = a.force[i] / mass[i];
    a.sum_x[i] = (first ? 0 : a.sum_x[i]) + weight * slope_x;
    a.sum_v[i] = (first ? 0 : a.sum_v[i]) + weight * slope_v;
    a.x[i] = a.x0[i] + step * slope_x;
    a.v[i] = a.v0[i] + step * slope_v;
  }
}

}  // namespace

void rk4(const state::MotionView& m, std::span<const float> mass, double time, double h, const Forces& forces,
         Scratch& scratch, const Jobs& jobs) {
  const std::size_t count = mass.size();
  const float dt = static_cast<float>(h);
  scratch.trial.resize(count);
  scratch.sum.resize(count);
  const state::MotionView t = scratch.trial.view(), s = scratch.sum.view();
  jobs.for_ranges(count, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      t.x[i] = m.x[i], t.y[i] = m.y[i], t.z[i] = m.z[i];
      t.vx[i] = m.vx[i], t.vy[i] = m.vy[i], t.vz[i] = m.vz[i];
    }
  });

  // Stage k is evaluated `at` into the step, weighs w / 6 and sends the trial `step` from the start for stage k + 1.
  struct Stage {
    float at, weight, step;
  };
  constexpr Stage kStages[] = {{0, 1, 0.5f}, {0.5f, 2, 0.5f}, {0.5f, 2, 1}, {1, 1, 0}};
  for (const Stage& stage : kStages) {
    const ForceView f = forces(t, time + stage.at * h);
    const bool first = &stage == kStages;
    jobs.for_ranges(count, 4096, [&](std::size_t begin, std::size_t end) {
      add_stage({m.x, m.vx, f.x, t.x, t.vx, s.x, s.vx}, mass, stage.weight, stage.step * dt, first, begin, end);
      add_stage({m.y, m.vy, f.y, t.y, t.vy, s.y, s.vy}, mass, stage.weight, stage.step * dt, first, begin, end);
      add_stage({m.z, m.vz, f.z, t.z, t.vz, s.z, s.vz}, mass, stage.weight, stage.step * dt, first, begin, end);
    });
  }
  const float sixth = dt / 6;
  jobs.for_ranges(count, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      m.x[i] += sixth * s.x[i], m.y[i] += sixth * s.y[i], m.z[i] += sixth * s.z[i];
      m.vx[i] += sixth * s.vx[i], m.vy[i] += sixth * s.vy[i], m.vz[i] += sixth * s.vz[i];
    }
  });
}

}  // namespace divot::integration
