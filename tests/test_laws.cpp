// The physics as pure functions of numbers: the paper's own figures, and each law against what it must obey.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "laws/blast.h"
#include "laws/damping.h"
#include "laws/ground.h"
#include "laws/lennard_jones.h"
#include "laws/mass_spring.h"

namespace divot::laws {
namespace {

constexpr float kWide = std::numeric_limits<float>::infinity();

// ---- the source of a blast

TEST(LawsBlast, DecibelsAreThePapersBothWays) {
  EXPECT_NEAR(from_decibel(210.6), 677'688, 1);
  EXPECT_NEAR(to_decibel(from_decibel(123.4)), 123.4, 1e-12);
}

TEST(LawsBlast, OneTon) {
  EXPECT_NEAR(shock_pressure(1), 677'688, 1);
  EXPECT_NEAR(blast_wave_pressure(shock_pressure(1)), 827'818, 2);
  EXPECT_NEAR(total_pressure(1), 1.50551e6, 10);
  EXPECT_DOUBLE_EQ(crater_width(1), 7.13232);
}

TEST(LawsBlast, FiveThousandTons) {
  EXPECT_NEAR(to_decibel(shock_pressure(5000)), 235.2721, 1e-4);
  EXPECT_NEAR(shock_pressure(5000), 11.6048e6, 100);
  EXPECT_NEAR(blast_wave_pressure(shock_pressure(5000)), 27.3409e6, 200);
  EXPECT_NEAR(total_pressure(5000), 38.9456e6, 200);
  EXPECT_NEAR(crater_width(5000), 121.961, 1e-3);
}

TEST(LawsBlast, BlastWaveEqualsShockAtFourteenThirdsOfAnAtmosphere) {
  const double equal = 14.0 / 3 * kAtmosphere;
  EXPECT_NEAR(equal, 472'850, 0.5);
  EXPECT_NEAR(blast_wave_pressure(equal), equal, 1e-6);
  EXPECT_NEAR(to_decibel(equal), 207.474, 1e-3);
  EXPECT_LT(blast_wave_pressure(0.9 * equal), 0.9 * equal);
  EXPECT_GT(blast_wave_pressure(1.1 * equal), 1.1 * equal);
}

TEST(LawsBlast, ForceOnThePapersParticles) {
  const double total = total_pressure(5000), width = crater_width(5000);
  const auto force = [&](double x) { return particle_force(pressure_at(total, x, 0), width, 98); };
  EXPECT_NEAR(force(1), 1.108e9, 0.001e9);
  EXPECT_NEAR(force(10), 1.108e6, 0.001e6);
  EXPECT_NEAR(force(100), 1108, 1);
}

TEST(LawsBlast, PressureEndsToRiseInsideTheCharge) {
  const double radius = charge_radius(5000), total = total_pressure(5000);
  EXPECT_NEAR(4.0 / 3 * std::numbers::pi * radius * radius * radius * kTntDensity, 5e6, 1);
  EXPECT_DOUBLE_EQ(pressure_at(total, 0, radius), pressure_at(total, radius, radius));
  EXPECT_LT(pressure_at(total, 1.01 * radius, radius), pressure_at(total, radius, radius));
}

TEST(LawsBlast, PulseScalesWithTheCubeRoot) {
  EXPECT_DOUBLE_EQ(pulse(1), kReferencePulse);
  EXPECT_NEAR(pulse(1000), 10 * kReferencePulse, 1e-12);
}

// Eq. 13 at Hopkinson's distance from the virtual source, times the cosine: the strength, exactly at the radius.
TEST(LawsBlast, PressureAtTheSurfaceRadiusIsTheStrength) {
  for (const double yield : {0.001, 0.25, 1.0, 100.0, 5000.0})
    for (const double strength : {300.0, 985.0, 13'000.0}) {
      const double radius = surface_radius(yield, strength), height = kSourceHeight * radius;
      const auto pressure = [&](double r) {
        const double x = std::hypot(r, height);
        return pressure_at(total_pressure(1), x / std::cbrt(yield), 0) * height / x;
      };
      EXPECT_NEAR(pressure(radius), strength, 1e-6 * strength);
      EXPECT_NEAR(surface_depth(yield, strength, 2), (pressure(0) - strength) * pulse(yield) / 4, 1e-6 * strength);
    }
}

TEST(LawsBlast, SurfaceRadiusGoesWithTheCubeRootOfYieldOverStrength) {
  const double one = surface_radius(1, 985);
  EXPECT_NEAR(surface_radius(1000, 985), 10 * one, 1e-9);
  EXPECT_NEAR(surface_radius(1, 985 * 8), one / 2, 1e-9);
}

TEST(LawsBlast, ThePapersModelIsEq14OverThePapersMass) {
  const Source low = paper_source(5000, 0), high = paper_source(5000, 100);
  EXPECT_NEAR(low.height, 0.265 * crater_width(5000), 1e-9);
  EXPECT_EQ(high.height, 100);
  const double force = particle_force(pressure_at(total_pressure(5000), 100, 0), crater_width(5000), 98);
  EXPECT_NEAR(paper_push(high, 100, 1), force / 1.0, 1e-9 * force);  // particles of 1 kg
  EXPECT_NEAR(paper_push(high, 100, 0.5), force / 2, 1e-9 * force);
}

// ---- cohesion

// e0 joules at rest length r0.
Medium molecules(float e0, float m, float n, float r0) {
  Material material;
  material.reference_spacing = r0;
  material.dissociation_energy = e0;
  material.attraction_exponent = m;
  material.repulsion_exponent = n;
  return make_medium(material);
}

// Force on one of two particles r apart, N, positive when it pushes them apart.
double force(const Medium& s, double r, float r0) {
  const float distance = static_cast<float>(r);
  return distance * lennard_jones(s, distance * distance, r0);
}

TEST(LawsLennardJones, ForceIsMinusTheGradientOfEq6) {
  constexpr float kRest = 10.9f;
  for (const auto& [m, n] : {std::pair{2.0f, 4.0f}, {6.0f, 12.0f}, {1.0f, 3.0f}, {2.5f, 3.5f}, {2.0f, 5.0f}}) {
    const Medium s = molecules(300, m, n, kRest);
    EXPECT_EQ(s.half_attraction > 0, m == 2 * std::floor(m / 2) && n == 2 * std::floor(n / 2));
    const auto phi = [&](double r) {
      return static_cast<double>(lennard_jones_potential(s, static_cast<float>(r), kRest));
    };
    for (double share = 0.85; share < 1.8; share += 0.05) {
      const double r = share * kRest, h = 0.01 * kRest;
      const double slope = (8 * (phi(r + h) - phi(r - h)) - (phi(r + 2 * h) - phi(r - 2 * h))) / (12 * h);
      EXPECT_NEAR(force(s, r, kRest), -slope, 2e-3 * (std::abs(slope) + 300 / kRest)) << m << ' ' << n << ' ' << share;
    }
  }
}

TEST(LawsLennardJones, ThePapersBond) {
  for (const float r0 : {0.5f, 1.0f, 10.9f}) {
    const Medium s = molecules(300, 2, 4, r0);
    EXPECT_NEAR(force(s, r0, r0), 0, 1e-4 / r0);
    EXPECT_NEAR(lennard_jones_potential(s, r0, r0), -300, 1e-3);
    EXPECT_NEAR(lennard_jones_potential(s, 0.70710678f * r0, r0), 0, 0.01);
    const double h = 0.01 * r0, stiffness = (force(s, r0 - h, r0) - force(s, r0 + h, r0)) / (2 * h);
    EXPECT_NEAR(stiffness, 2400 / (r0 * r0), 0.005 * 2400 / (r0 * r0));
    EXPECT_NEAR(s.bond_stiffness(), 2400 / (r0 * r0), 1e-3 * 2400 / (r0 * r0));
  }
}

TEST(LawsLennardJones, StrongestPull) {
  constexpr float kRest = 2.0f;
  const Medium s = molecules(300, 2, 4, kRest);
  double strongest = 0, at = 0;
  for (double r = kRest; r < 3 * kRest; r += 1e-4 * kRest)
    if (const double pull = -force(s, r, kRest); pull > strongest) strongest = pull, at = r;
  EXPECT_NEAR(strongest, 223.08 / kRest, 0.01);
  EXPECT_NEAR(at, 1.29099 * kRest, 0.003 * kRest);
}

// The same sheet on any mesh: energy goes with the square of the rest length.
TEST(LawsLennardJones, StiffnessDoesNotDependOnTheRestLength) {
  const Medium s = molecules(300, 2, 4, 10.9f);
  const auto stiffness = [&](float r0) { return (force(s, 0.99 * r0, r0) - force(s, 1.01 * r0, r0)) / (0.02 * r0); };
  EXPECT_NEAR(stiffness(1), stiffness(10.9f), 1e-3 * stiffness(1));
}

TEST(LawsMassSpring, IsHookes) {
  Medium s;
  s.spring_stiffness = 20;
  EXPECT_EQ(mass_spring(s, 2.0f, 2.0f), 0);
  EXPECT_FLOAT_EQ(3 * mass_spring(s, 3.0f, 2.0f), -20);  // stretched by 1 m: pulls
  EXPECT_FLOAT_EQ(1 * mass_spring(s, 1.0f, 2.0f), 20);
}

TEST(LawsDamping, OpposesMotion) {
  const Vec3 a{1, 2, 3}, b{4, -5, 6};
  EXPECT_EQ(viscous_damping(2, a, b), (Vec3{6, -14, 6}));
  EXPECT_EQ(viscous_damping(2, a, b), -viscous_damping(2, b, a));
  EXPECT_EQ(global_damping(0.5f, b), (Vec3{-2, 2.5f, -3}));
}

// ---- soil

Medium soil(double kc, double kphi, double n, double elastic) {
  Material material;
  material.bekker_kc = kc, material.bekker_kphi = kphi, material.bekker_n = n;
  material.elastic_stiffness = elastic;
  material.cohesion = 100, material.friction_angle_deg = 30, material.shear_modulus = 0.02;
  return make_medium(material);
}

TEST(LawsSoil, BekkersPressure) {
  const Medium s = soil(990, 1.5284e6, 1.1, 9e7);
  EXPECT_NEAR(bekker_pressure<double>(s, 0.1, 0.3), (990 / 0.3 + 1.5284e6) * std::pow(0.1, 1.1), 1);
  EXPECT_NEAR(bekker_pressure<float>(s, 0.1f, kWide), 1.5284e6 * std::pow(0.1, 1.1), 1);
  EXPECT_EQ(bekker_pressure<double>(s, -0.1, 0.3), 0);
}

TEST(LawsSoil, UnloadsAndReloadsElasticallyAndGoesOnAlongTheCurve) {
  const Medium s = soil(0, 2e5, 1.1, 4e6);
  const auto at = [&](double z, double plastic) { return ground_pressure<double>(s, z, plastic, 1, 4e6); };
  const auto loaded = at(0.1, 0);
  EXPECT_TRUE(loaded.yields);
  EXPECT_NEAR(loaded.value, 2e5 * std::pow(0.1, 1.1), 1e-2);
  EXPECT_NEAR(loaded.slope, (at(0.1001, 0).value - at(0.0999, 0).value) / 2e-4, 1);
  // What stays when the load is gone.
  const double plastic = 0.1 - loaded.value / 4e6;
  EXPECT_GT(plastic, 0.09);
  EXPECT_EQ(at(plastic, plastic).value, 0);
  EXPECT_EQ(at(0.5 * plastic, plastic).value, 0);
  const double half = 0.5 * (plastic + 0.1);
  EXPECT_FALSE(at(half, plastic).yields);
  EXPECT_NEAR(at(half, plastic).value, 0.5 * loaded.value, 1e-6 * loaded.value);
  EXPECT_EQ(at(half, plastic).slope, 4e6);
  EXPECT_NEAR(at(0.1, plastic).value, loaded.value, 1e-6 * loaded.value);
  EXPECT_TRUE(at(0.11, plastic).yields);
  EXPECT_NEAR(at(0.11, plastic).value, at(0.11, 0).value, 1e-9 * loaded.value);
}

// Clay with n = 0.1 would be infinitely stiff at first: the elastic branch leads until the curve is met.
TEST(LawsSoil, TheElasticBranchLeadsWhereTheCurveIsSteeper) {
  const Medium s = soil(0, 5e4, 0.1, 1e7);
  const double meets = std::pow(5e4 / 1e7, 1 / 0.9);
  const auto before = ground_pressure<double>(s, 0.5 * meets, 0, 1, 1e7);
  EXPECT_FALSE(before.yields);
  EXPECT_NEAR(before.value, 1e7 * 0.5 * meets, 1e-6 * before.value);
  const auto after = ground_pressure<double>(s, 2 * meets, 0, 1, 1e7);
  EXPECT_TRUE(after.yields);
  EXPECT_NEAR(after.value, 5e4 * std::pow(2 * meets, 0.1), 1e-2);
  double last = 0;
  for (double z = 0; z < 3 * meets; z += 0.01 * meets) {
    const double value = ground_pressure<double>(s, z, 0, 1, 1e7).value;
    EXPECT_GE(value, last);
    last = value;
  }
}

TEST(LawsSoil, WavesCarryNoMoreThanQuickStrength) {
  Medium s = soil(0, 2e5, 1.1, 4e6);
  s.ground_damping = 1e4;
  const auto at = [&](double z, double plastic, double speed) {
    return ground_pressure<double>(s, z, plastic, 1, 4e6, speed);
  };
  const double curve = bekker_pressure<double>(s, 0.1, 1);
  for (const double plastic : {0.0, 0.099}) {
    const double at_rest = at(0.1, plastic, 0).value;
    EXPECT_NEAR(at(0.1, plastic, 0.1).value, at_rest + 1e3, 1e-6);
    EXPECT_FLOAT_EQ(static_cast<float>(at(0.1, plastic, 0.1).damping), 1e4f);
    EXPECT_EQ(at(0.1, plastic, -0.1).value, at_rest) << "none on the way up";
    EXPECT_DOUBLE_EQ(at(0.1, plastic, 100).value, kQuickStrength * curve);
    EXPECT_EQ(at(0.1, plastic, 100).damping, 0);
    EXPECT_NEAR(at(0.1, plastic, 100).slope, (at(0.1001, plastic, 100).value - at(0.0999, plastic, 100).value) / 2e-4,
                1e2);
  }
}

TEST(LawsSoil, ThrownSoilPushesBackWithTheSquareOfTheSpeed) {
  Medium s;
  s.density = 1600, s.tan_friction = 0.6f;
  EXPECT_NEAR(thrown_pressure<double>(s, 3).per_speed,
              (thrown_pressure<double>(s, 3.001).value - thrown_pressure<double>(s, 2.999).value) / 2e-3, 1);
  EXPECT_EQ(thrown_pressure<double>(s, -3).value, 0);
  // On a ball in by half, at its speed: that of balls in dry grains, m v^2 / d1.
  constexpr int kRings = 1000;
  double mean = 0;
  for (int k = 0; k < kRings; ++k) {
    const double squared = (k + 0.5) / kRings;  // of the distance from the axis
    mean += thrown_pressure<double>(s, 3 * std::sqrt(1 - squared)).value / kRings;
  }
  const double ball = 2500, d = 0.2, d1 = 0.25 * d * ball / (s.density * s.tan_friction);
  const double mass = ball * std::numbers::pi / 6 * d * d * d, area = std::numbers::pi / 4 * d * d;
  EXPECT_NEAR(mean * area, mass * 9 / d1, 1e-3 * mean * area);
  s.tan_friction = 0;
  EXPECT_NEAR(thrown_pressure<double>(s, 2).value, 0.5 * 1600 * 4, 1e-3);
}

TEST(LawsSoil, QuickLoadingAddsTheLargerOfWavesAndThrownSoil) {
  Medium s = soil(0, 2e5, 1.1, 4e6);
  s.ground_damping = 1e4, s.density = 1600, s.tan_friction = 0.6f;
  const auto at = [&](double plastic, double speed, double across) {
    return ground_pressure<double>(s, 0.1, plastic, 1, 4e6, speed, across);
  };
  const double curve = bekker_pressure<double>(s, 0.1, 1);
  EXPECT_EQ(at(0, 0.1, 0.1).value, curve + 1e3) << "waves";
  EXPECT_EQ(at(0, 0.1, 0.1).throwing, 0);
  EXPECT_EQ(at(0, 10, 10).value, curve + thrown_pressure<double>(s, 10).value);
  EXPECT_EQ(at(0, 10, 10).damping, 0);
  EXPECT_EQ(at(0, 10, 10).throwing, thrown_pressure<double>(s, 10).per_speed);
  EXPECT_EQ(at(0.0999, 0, 10).value, at(0.0999, 0, 0).value) << "only what yields is thrown";
}

TEST(LawsSoil, ShearStrengthIsMohrCoulombs) {
  const Medium s = soil(0, 1e5, 1, 1e6);
  EXPECT_FLOAT_EQ(shear_strength(s, 0.0f), 100);
  EXPECT_NEAR(shear_strength(s, 1000.0), 100 + 1000 * std::tan(std::numbers::pi / 6), 1e-3);
}

TEST(LawsSoil, ShearIsMobilisedAfterJanosiAndHanamoto) {
  const Medium s = soil(0, 1e5, 1, 1e6);
  EXPECT_EQ(mobilised_shear(s, 0.0), 0);
  EXPECT_NEAR(mobilised_shear(s, 0.02), 1 - std::exp(-1), 1e-6);
  EXPECT_NEAR(mobilised_shear(s, kSlideShear * 0.02), 0.95, 0.001);
}

TEST(LawsGround, AnswersPressureShearAndPull) {
  const Medium s = soil(0, 2e5, 1, 1e6);
  const Resolution fine{1e9f};
  const auto traction = [&](const Vec3& moved) { return ground_traction(s, moved, {}, 0, fine); };
  EXPECT_EQ(traction({}), Vec3{});
  EXPECT_NEAR(traction({0, 0, -0.1f}).z, 2e4, 1);
  // Pulled: elastic at first, never more than cohesion.
  EXPECT_NEAR(traction({0, 0, 0.5e-4f}).z, -50, 0.01);
  EXPECT_FLOAT_EQ(traction({0, 0, 1}).z, -100);
  Medium heavy = s;
  heavy.weight = 50;
  EXPECT_FLOAT_EQ(ground_traction(heavy, {0, 0, 1}, {}, 0, fine).z, -150);
  // Sheared: against the displacement, up to the strength under the pressure that is there.
  const Vec3 sheared = traction({0.3f, 0.4f, -0.1f});
  const double strength = 100 + 2e4 * std::tan(std::numbers::pi / 6);
  EXPECT_NEAR(std::hypot(sheared.x, sheared.y), strength, 1e-3 * strength);
  EXPECT_NEAR(sheared.y / sheared.x, 4.0 / 3, 1e-5);
  EXPECT_LT(sheared.x, 0);
}

TEST(LawsGround, DampsAndSoftensToWhatASubstepCanFollow) {
  const Medium s = soil(0, 2e5, 1, 1e6);
  const Resolution fine{1e9f}, coarse{100};
  EXPECT_FLOAT_EQ(ground_traction(s, {}, {0, 0, 2}, 0, fine).z, -2 * s.ground_damping);
  EXPECT_LT(held_stiffness(s, coarse), s.elastic_stiffness);
  EXPECT_FLOAT_EQ(held_stiffness(s, coarse), coarse.stiffness_limit() * s.areal_mass);
  EXPECT_FLOAT_EQ(held_stiffness(s, fine), 1e6f);
}

TEST(LawsMedium, ScalesWithTheReferenceSpacing) {
  Material material;
  material.reference_spacing = 2, material.particle_mass = 8, material.dissociation_energy = 12;
  material.global_damping = 4, material.friction_angle_deg = 45;
  const Medium s = make_medium(material);
  EXPECT_FLOAT_EQ(s.areal_mass, 2);
  EXPECT_FLOAT_EQ(s.bond_energy, 3);
  EXPECT_FLOAT_EQ(s.areal_damping, 1);
  EXPECT_FLOAT_EQ(s.tan_friction, 1);
  EXPECT_EQ(s.half_attraction, 1);
  EXPECT_EQ(s.half_repulsion, 2);
}

}  // namespace
}  // namespace divot::laws
