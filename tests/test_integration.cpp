// Both integrators: order of convergence on motions with a known solution, and equivalence of threads.
#include "integration/integrators.h"
#include "support.h"

namespace divot::integration {
namespace {

using Scheme = std::function<void(const state::MotionView&, std::span<const float>, double, double, const Forces&)>;

Scratch scratch;

const Scheme kEuler = [](const auto& m, auto mass, double t, double h, const Forces& f) {
  euler(m, mass, t, h, f, Jobs(1));
};
const Scheme kRk4 = [](const auto& m, auto mass, double t, double h, const Forces& f) {
  rk4(m, mass, t, h, f, scratch, Jobs(1));
};

// Three oscillators at once, one on each axis, of different frequency, damping and phase, 2 kg.
constexpr float kMass = 2, kFrequency[3] = {1, 0.7f, 1.3f}, kDamping[3] = {0, 0.2f, 0.1f};

double exact(int axis, double t) {
  const double c = 0.5 * kDamping[axis], w = std::sqrt(kFrequency[axis] * kFrequency[axis] - c * c);
  return std::exp(-c * t) * (std::cos(w * t) + c / w * std::sin(w * t));  // from 1 m at rest
}

double error(const Scheme& scheme, double end, int steps) {
  state::Motion motion;
  motion.resize(1);
  motion.x[0] = motion.y[0] = motion.z[0] = 1;
  const std::vector<float> mass = {kMass};
  std::vector<float> f(3);
  const Forces forces = [&](const state::MotionView& m, double) {
    const float x[3] = {m.x[0], m.y[0], m.z[0]}, v[3] = {m.vx[0], m.vy[0], m.vz[0]};
    for (int a = 0; a < 3; ++a) f[a] = -kMass * (kFrequency[a] * kFrequency[a] * x[a] + kDamping[a] * v[a]);
    return ForceView{{&f[0], 1}, {&f[1], 1}, {&f[2], 1}};
  };
  const double h = end / steps;
  for (int k = 0; k < steps; ++k) scheme(motion.view(), mass, k * h, h, forces);
  return std::abs(motion.x[0] - exact(0, end)) + std::abs(motion.y[0] - exact(1, end)) +
         std::abs(motion.z[0] - exact(2, end));
}

// Steps are long enough that the rounding of floats does not show.
TEST(Integration, Rk4IsOfOrderFour) {
  const double coarse = error(kRk4, 8, 24), fine = error(kRk4, 8, 48);
  EXPECT_NEAR(std::log2(coarse / fine), 4, 0.5) << coarse << ' ' << fine;
  EXPECT_LT(fine, 1e-3);
}

TEST(Integration, EulerIsOfOrderOne) {
  const double coarse = error(kEuler, 8, 200), fine = error(kEuler, 8, 400);
  EXPECT_NEAR(std::log2(coarse / fine), 1, 0.2) << coarse << ' ' << fine;
}

TEST(Integration, Rk4IsTheMoreExactAtTheSameCost) { EXPECT_LT(20 * error(kRk4, 8, 50), error(kEuler, 8, 200)); }

// A force that changes with time alone: RK4 must look at it in the middle and at the end of the step.
TEST(Integration, Rk4FollowsAForceThatChangesWithTime) {
  const auto final_speed = [&](int steps) {
    state::Motion motion;
    motion.resize(1);
    const std::vector<float> mass = {1}, none = {0};
    std::vector<float> push(1);
    const Forces forces = [&](const state::MotionView&, double t) {
      push[0] = static_cast<float>(4 * t * t * t);
      return ForceView{push, none, none};
    };
    for (int k = 0; k < steps; ++k) rk4(motion.view(), mass, 2.0 * k / steps, 2.0 / steps, forces, scratch, Jobs(1));
    return motion.vx[0];
  };
  EXPECT_NEAR(final_speed(1), 16, 1e-5);  // Simpson's rule is exact for cubics
  EXPECT_NEAR(final_speed(7), 16, 1e-4);
}

// Semi-implicit Euler keeps the energy of an oscillator within bounds where explicit Euler would let it grow.
TEST(Integration, EulerKeepsEnergyBounded) {
  state::Motion motion;
  motion.resize(1);
  motion.x[0] = 1;
  const std::vector<float> mass = {1}, none = {0};
  std::vector<float> pull(1);
  const Forces forces = [&](const state::MotionView& m, double) {
    pull[0] = -m.x[0];
    return ForceView{pull, none, none};
  };
  for (int k = 0; k < 10'000; ++k) {
    euler(motion.view(), mass, 0.1 * k, 0.1, forces, Jobs(1));
    ASSERT_NEAR(motion.x[0] * motion.x[0] + motion.vx[0] * motion.vx[0], 1, 0.12);
  }
}

TEST(Integration, ThreadsDoNotChangeABit) {
  constexpr std::size_t kCount = 20'000;
  test::Random random(7);
  state::Motion start;
  start.resize(kCount);
  std::vector<float> mass(kCount), fx(kCount), fy(kCount), fz(kCount);
  for (auto* array : {&start.x, &start.y, &start.z, &start.vx, &start.vy, &start.vz})
    for (float& number : *array) number = random.in(-1.0f, 1.0f);
  for (float& m : mass) m = random.in(0.5f, 2.0f);
  const Forces forces = [&](const state::MotionView& m, double) {
    for (std::size_t i = 0; i < kCount; ++i) fx[i] = -m.x[i], fy[i] = -m.y[i] - m.vy[i], fz[i] = m.x[i] * m.y[i];
    return ForceView{fx, fy, fz};
  };
  const auto end = [&](bool fourth, int threads) {
    const Jobs jobs(threads);
    state::Motion motion = start;
    for (int k = 0; k < 3; ++k)
      fourth ? rk4(motion.view(), mass, 0, 0.1, forces, scratch, jobs)
             : euler(motion.view(), mass, 0, 0.1, forces, jobs);
    return motion;
  };
  for (const bool fourth : {false, true}) {
    const state::Motion alone = end(fourth, 1);
    for (const int threads : {2, 8}) {
      const state::Motion shared = end(fourth, threads);
      EXPECT_EQ(alone.x, shared.x);
      EXPECT_EQ(alone.y, shared.y);
      EXPECT_EQ(alone.vz, shared.vz);
    }
  }
}

}  // namespace
}  // namespace divot::integration
