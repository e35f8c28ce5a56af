#include "integration/integrators.h"

namespace divot::integration {

void euler(const state::MotionView& m, std::span<const float> mass, double time, double h, const Forces& forces,
           const Jobs& jobs) {
  const ForceView f = forces(m, time);
  const float dt = static_cast<float>(h);
  jobs.for_ranges(mass.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const float impulse = dt / mass[i];
      m.vx[i] += impulse * f.x[i], m.vy[i] += impulse * f.y[i], m.vz[i] += impulse * f.z[i];
      m.x[i] += dt * m.vx[i], m.y[i] += dt * m.vy[i], m.z[i] += dt * m.vz[i];
    }
  });
}

}  // namespace divot::integration
