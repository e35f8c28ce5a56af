#include <atomic>
#include <functional>

#include "integration/axis.h"

namespace divot::integration {

bool euler(const state::MotionView& m, std::span<const float> mass, double time, double h, const Forces& forces,
           const Jobs& jobs) {
  const ForceView f = forces(m, time);
  const float dt = static_cast<float>(h);
  std::atomic<bool> numbers = true;
  const auto move = [&](std::size_t begin, std::size_t end) {
    const auto axis = [&](const float* force, float* x, float* v) {
      const float* const kg = mass.data();
      int bad = 0;
      for (std::size_t i = begin; i < end; ++i) {
        const float speed = v[i] + dt / kg[i] * force[i], place = x[i] + dt * speed;
        v[i] = speed, x[i] = place;
        bad |= is_no_number(speed) | is_no_number(place);
      }
      return bad;
    };
    const int bad = axis(f.x.data(), m.x.data(), m.vx.data()) | axis(f.y.data(), m.y.data(), m.vy.data()) |
                    axis(f.z.data(), m.z.data(), m.vz.data());
    if (bad != 0) numbers = false;
  };
  // By reference: a copy in std::function would be an allocation.
  jobs.for_ranges(mass.size(), kGrain, std::ref(move));
  return numbers;
}

}  // namespace divot::integration
