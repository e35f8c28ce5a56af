// Forces on particles: conservation, a double sum over all pairs, threads, and what yields.
#include "forces/evaluate.h"
#include "support.h"

namespace divot::forces {
namespace {

using test::Sheet;

constexpr float kSpacing = 2, kCutoff = 1.75f * kSpacing;
const laws::Resolution kFine{1e18f};

// Two soils that differ in everything pairs depend on; bare sheets have nothing but pairs.
std::vector<Material> two_soils(bool bare) {
  Material soft, stiff;
  for (Material* m : {&soft, &stiff}) {
    m->reference_spacing = kSpacing;
    m->ground = !bare;
    if (bare) m->global_damping = 0;
  }
  stiff.dissociation_energy *= 5, stiff.viscous_damping *= 3, stiff.spring_stiffness *= 4, stiff.particle_mass = 3;
  return {soft, stiff};
}

// A sheet whose particles have moved at random since their bonds formed.
Sheet shaken_sheet(int size, bool bare, unsigned seed) {
  Sheet s = test::make_sheet({.columns = size, .rows = size, .spacing = kSpacing}, two_soils(bare));
  test::Random random(seed);
  state::Particles& p = s.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.material[i] = static_cast<std::uint8_t>(random.below(2));
    p.mass[i] = s.media[p.material[i]].areal_mass * s.soil.cell[p.column[i]];
  }
  test::bond(s, kCutoff);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const float far = 0.2f * kSpacing;
    p.set_position(i, p.position(i) + Vec3{random.in(-far, far), random.in(-far, far), random.in(-far, far)});
    p.set_velocity(i, {random.in(-1.0f, 1.0f), random.in(-1.0f, 1.0f), random.in(-1.0f, 1.0f)});
  }
  return s;
}

void evaluate_sheet(Sheet& s, Cohesion cohesion, int threads = 1, std::span<const state::Blast> blasts = {},
                    double time = 0) {
  const Field field{s.soil, s.media, blasts, cohesion, kCutoff, kFine};
  Scratch scratch;
  evaluate(s.particles, s.bonds, s.motion(), time, field, Renew::no, scratch, Jobs(threads));
}

Vec3d force_on(const Sheet& s, std::size_t i) {
  return to_double(Vec3{s.particles.fx[i], s.particles.fy[i], s.particles.fz[i]});
}

TEST(Forces, PairsSumToZero) {
  for (const Cohesion cohesion : {Cohesion::lennard_jones, Cohesion::mass_spring}) {
    Sheet s = shaken_sheet(20, true, 1);
    evaluate_sheet(s, cohesion);
    Vec3d sum;
    double size = 0;
    for (std::size_t i = 0; i < s.particles.size(); ++i) sum += force_on(s, i), size += length(force_on(s, i));
    EXPECT_GT(size, 1);
    EXPECT_LT(length(sum), 1e-6 * size);
  }
}

// Cohesion acts along the line between two particles; eq. 2 does not, so it is left out here.
TEST(Forces, CohesionTurnsNothing) {
  for (const Cohesion cohesion : {Cohesion::lennard_jones, Cohesion::mass_spring}) {
    Sheet s = shaken_sheet(20, true, 2);
    for (laws::Medium& m : s.media) m.viscous_damping = 0;
    evaluate_sheet(s, cohesion);
    Vec3d sum;
    double size = 0;
    for (std::size_t i = 0; i < s.particles.size(); ++i) {
      const Vec3d torque = cross(to_double(s.particles.position(i)), force_on(s, i));
      sum += torque, size += length(torque);
    }
    EXPECT_GT(size, 1);
    EXPECT_LT(length(sum), 1e-6 * size);
  }
}

// What rubs takes energy away and never gives any.
TEST(Forces, DampingTakesEnergy) {
  Sheet s = shaken_sheet(12, true, 3);
  for (laws::Medium& m : s.media) m.bond_energy = 0;
  evaluate_sheet(s, Cohesion::lennard_jones);
  double power = 0;
  for (std::size_t i = 0; i < s.particles.size(); ++i) power += dot(force_on(s, i), to_double(s.particles.velocity(i)));
  EXPECT_LT(power, 0);
}

// Every pair that was in range at rest, in doubles and from eq. 6 and 1 as they are printed.
Vec3d pair_sum(const Sheet& s, std::size_t i, Cohesion cohesion, const std::vector<Material>& soils) {
  const state::Particles& p = s.particles;
  Vec3d sum;
  for (std::size_t j = 0; j < p.size(); ++j) {
    const double rest = length(to_double(s.surface.position[p.vertex[i]] - s.surface.position[p.vertex[j]]));
    if (j == i || rest >= kCutoff) continue;
    const Vec3d apart = to_double(p.position(i)) - to_double(p.position(j));
    const double r = length(apart);
    if (r >= kCutoff) continue;
    const Material& soil = soils[std::min(p.material[i], p.material[j])];  // the first is the weaker
    const double e0 = soil.dissociation_energy * (rest / kSpacing) * (rest / kSpacing);
    const double m = soil.attraction_exponent, n = soil.repulsion_exponent;
    const double push = cohesion == Cohesion::lennard_jones
                            ? e0 * m * n / (n - m) * (std::pow(rest / r, n) - std::pow(rest / r, m)) / r
                            : soil.spring_stiffness * (rest - r);
    const double t = std::min(1.0, (kCutoff * kCutoff - r * r) / (0.19 * kCutoff * kCutoff)),
                 near = t * t * (3 - 2 * t);
    const Vec3d relative = to_double(p.velocity(j)) - to_double(p.velocity(i));
    sum += near * (push * (1 / r) * apart + soil.viscous_damping * relative);
  }
  return sum;
}

TEST(Forces, EqualADoubleSumOverAllPairs) {
  for (const bool bare : {true, false})
    for (const Cohesion cohesion : {Cohesion::lennard_jones, Cohesion::mass_spring}) {
      Sheet s = shaken_sheet(11, bare, 4);
      const std::vector<Material> soils = two_soils(bare);
      evaluate_sheet(s, cohesion);
      for (std::size_t i = 0; i < s.particles.size(); ++i) {
        const laws::Medium& medium = s.media[s.particles.material[i]];
        const std::uint32_t column = s.particles.column[i];
        const float area = s.soil.cell[column];
        const Vec3 v = s.particles.velocity(i), moved = s.particles.position(i) - s.soil.rest[column];
        Vec3d expected =
            pair_sum(s, i, cohesion, soils) - static_cast<double>(medium.areal_damping * area) * to_double(v);
        if (!bare) expected += to_double(area * laws::ground_traction(medium, moved, v, 0, kFine));
        EXPECT_LT(length(force_on(s, i) - expected), 1e-4 * (1 + length(expected))) << i;
      }
    }
}

TEST(Forces, ThreadsDoNotChangeABit) {
  Sheet one = shaken_sheet(70, false, 5);
  evaluate_sheet(one, Cohesion::lennard_jones, 1);
  for (const int threads : {2, 8}) {
    Sheet many = shaken_sheet(70, false, 5);
    evaluate_sheet(many, Cohesion::lennard_jones, threads);
    EXPECT_EQ(one.particles.fx, many.particles.fx);
    EXPECT_EQ(one.particles.fy, many.particles.fy);
    EXPECT_EQ(one.particles.fz, many.particles.fz);
  }
}

TEST(Forces, AnchorsFeelNothingAndTheCarriedOnlyRememberTheirPull) {
  Sheet s = shaken_sheet(9, false, 6);
  evaluate_sheet(s, Cohesion::lennard_jones);
  const double pull = pair_sum(s, 41, Cohesion::lennard_jones, two_soils(false)).z;
  s.particles.hold[40] = Hold::anchor;
  s.particles.hold[41] = Hold::carried;
  evaluate_sheet(s, Cohesion::lennard_jones);
  EXPECT_EQ(length(force_on(s, 40)), 0);
  EXPECT_EQ(length(force_on(s, 41)), 0);
  EXPECT_NEAR(s.particles.held_pull[41], pull, 1e-3);
}

TEST(Forces, ABlastPushesItsColumnsWhileItsPulseLasts) {
  Sheet s = test::make_sheet({.columns = 9, .rows = 9, .spacing = kSpacing}, two_soils(true));
  test::bond(s, kCutoff);
  state::Blast blast{.direction = {0, 0.6f, -0.8f}, .start = 1, .pulse = 0.5};
  blast.column = {40, 41, 42}, blast.push = {10, 20, 30};
  s.particles.hold[42] = Hold::carried;
  EXPECT_EQ(pulse_shape(blast, 1), 1);
  EXPECT_NEAR(pulse_shape(blast, 1.25), 0.5, 1e-6);
  EXPECT_EQ(pulse_shape(blast, 1.5), 0);
  evaluate_sheet(s, Cohesion::lennard_jones, 1, {&blast, 1}, 1.25);
  const double push = 0.5 * 20 * s.particles.mass[41];
  EXPECT_LT(length(force_on(s, 41) - Vec3d{0, 0.6 * push, -0.8 * push}), 1e-4 * push);
  EXPECT_LT(length(force_on(s, 0)), 1e-4 * push);
  EXPECT_LT(length(force_on(s, 42)), 1e-4 * push);
  evaluate_sheet(s, Cohesion::lennard_jones, 1, {&blast, 1}, 1.5);
  EXPECT_LT(length(force_on(s, 41)), 1e-4 * push);
}

TEST(Forces, GroundThatFlowsHasDragAlone) {
  Sheet s = test::make_sheet({.columns = 5, .rows = 5, .spacing = kSpacing}, two_soils(false));
  test::bond(s, kCutoff);
  s.particles.flow_rate.assign(s.particles.size(), 3);
  test::renew(s.particles, s.bonds, s.soil, s.media, kCutoff);
  for (const float r0 : s.bonds.rest_length) EXPECT_LE(r0, 0);
  s.particles.z[12] -= 1;
  s.particles.vz[12] = -2;
  evaluate_sheet(s, Cohesion::lennard_jones);
  EXPECT_NEAR(s.particles.fz[12], 6 * s.particles.mass[12], 1e-4);
}

// Softened bonds and ground are softened alike for either side of a pair.
TEST(Forces, SofteningKeepsTheSumOfPairsZero) {
  Sheet s = shaken_sheet(15, true, 8);
  const Field field{s.soil, s.media, {}, Cohesion::lennard_jones, kCutoff, {2}};
  Scratch scratch;
  evaluate(s.particles, s.bonds, s.motion(), 0, field, Renew::no, scratch, Jobs(1));
  Vec3d sum;
  double size = 0;
  for (std::size_t i = 0; i < s.particles.size(); ++i) sum += force_on(s, i), size += length(force_on(s, i));
  EXPECT_LT(length(sum), 1e-6 * size);
  Sheet full = shaken_sheet(15, true, 8);
  evaluate_sheet(full, Cohesion::lennard_jones);
  EXPECT_LT(length(force_on(s, 100)), length(force_on(full, 100)));
}

// ---- kernels

// Everything a kernel reads, shaken at random: particles in any hold, some flowing, some far out of range, in one
// medium or two, a number that does not fill the last block.
struct Tangle {
  Sheet s;
  std::vector<Terms> terms;

  Tangle(unsigned seed, bool mixed, double attraction, double repulsion, double bekker_n) {
    std::vector<Material> soils = two_soils(false);
    for (Material& soil : soils)
      soil.attraction_exponent = attraction, soil.repulsion_exponent = repulsion, soil.bekker_n = bekker_n;
    s = test::make_sheet({.columns = 37, .rows = 23, .spacing = kSpacing}, soils);
    test::Random random(seed);
    state::Particles& p = s.particles;
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (mixed && i % 200 > 150) p.material[i] = 1;
      p.flow_rate[i] = random.below(10) == 0 ? random.in(0.0f, 5.0f) : 0;
      p.hold[i] = static_cast<Hold>(random.below(20) > 3 ? 0 : random.below(4));
      s.soil.plastic[i] = random.below(2) == 0 ? random.in(0.0f, 0.3f) : 0;
    }
    test::bond(s, kCutoff);
    for (std::size_t i = 0; i < p.size(); ++i) {
      const float far = random.below(8) == 0 ? kSpacing : 0.05f * kSpacing;
      p.set_position(i, p.position(i) + Vec3{random.in(-far, far), random.in(-far, far), random.in(-far, far)});
      p.set_velocity(i, {random.in(-1.0f, 1.0f), random.in(-1.0f, 1.0f), random.in(-1.0f, 1.0f)});
    }
  }
};

struct KernelResult {
  std::vector<float> fx, fy, fz, pull, rest_length;
  friend bool operator==(const KernelResult&, const KernelResult&) = default;
};

KernelResult run_kernel(Kernel* kernel, Tangle& t, Cohesion cohesion, float rate, Renew renew) {
  Sheet& s = t.s;
  Scratch scratch;
  const Field field{s.soil, s.media, {}, cohesion, kCutoff, {rate}};
  state::Bonds bonds = s.bonds;
  evaluate(s.particles, bonds, s.motion(), 0, field, renew, scratch, Jobs(1), kernel);
  return {s.particles.fx, s.particles.fy, s.particles.fz, s.particles.held_pull, bonds.rest_length};
}

TEST(ForcesKernel, AllGiveTheBitsOfThePlainOne) {
  const std::vector<Kernel*> kernels = forces::kernels();
  unsigned seed = 30;
  for (const bool mixed : {false, true})
    for (const auto& [m, n, bekker_n] : {std::tuple{2.0, 4.0, 1.0}, {6.0, 12.0, 1.1}, {2.0, 3.0, 0.5}})
      for (const Cohesion cohesion : {Cohesion::lennard_jones, Cohesion::mass_spring})
        for (const float rate : {1e18f, 2.0f})
          for (const Renew renew : {Renew::no, Renew::yes}) {
            Tangle tangle(++seed, mixed, m, n, bekker_n);
            const KernelResult expected = run_kernel(&plain, tangle, cohesion, rate, renew);
            EXPECT_EQ(renew == Renew::yes, expected.rest_length != tangle.s.bonds.rest_length);
            for (Kernel* kernel : kernels)
              EXPECT_EQ(run_kernel(kernel, tangle, cohesion, rate, renew), expected) << seed;
          }
}

// ---- yield

// Two particles of a sheet, one moved along x by `strain` of their rest length.
float rest_length_after(double strain) {
  Material soil;
  soil.yield_strain = 0.02;
  Sheet s = test::make_sheet({.columns = 3, .rows = 3, .spacing = kSpacing}, {soil});
  test::bond(s, 1.2f * kSpacing);
  s.particles.hold.assign(9, Hold::anchor);
  const float right = s.particles.x[5];
  s.particles.x[5] = right + static_cast<float>(strain) * kSpacing;
  test::renew(s.particles, s.bonds, s.soil, s.media, 1.2f * kSpacing);
  float length = 0;
  s.bonds.for_each_entry(4, [&](std::size_t e) {
    if (s.bonds.neighbour[e] == 5) length = s.bonds.rest_length[e];
  });
  return length;
}

TEST(ForcesYield, BondsKeepTheirLengthUpToTheYieldStrainAndFollowBeyond) {
  EXPECT_FLOAT_EQ(rest_length_after(0), kSpacing);
  EXPECT_FLOAT_EQ(rest_length_after(0.019), kSpacing);
  EXPECT_FLOAT_EQ(rest_length_after(-0.019), kSpacing);
  EXPECT_NEAR(rest_length_after(0.1), 1.1 / 1.02 * kSpacing, 1e-5);
  EXPECT_NEAR(rest_length_after(-0.1), 0.9 / 0.98 * kSpacing, 1e-5);
}

// One free particle moved from rest; its column after yield().
state::Soil ground_after(const Vec3& moved, const Material& soil) {
  Sheet s = test::make_sheet({.columns = 3, .rows = 3, .spacing = kSpacing}, {soil});
  test::bond(s, kCutoff);
  s.particles.set_position(4, s.particles.position(4) + moved);
  yield(s.particles, s.soil, s.media, kFine, Jobs(1));
  return s.soil;
}

Material firm_soil() {
  Material soil;
  soil.bekker_kphi = 1e4, soil.bekker_n = 1, soil.elastic_stiffness = 1e5;
  soil.cohesion = 100, soil.shear_modulus = 0.01;
  return soil;
}

TEST(ForcesYield, SinkageOnBekkersCurveStaysButForItsElasticPart) {
  const state::Soil soil = ground_after({0, 0, -0.5f}, firm_soil());
  EXPECT_NEAR(soil.plastic[4], 0.5 - 1e4 * 0.5 / 1e5, 1e-5);
  EXPECT_NEAR(soil.rest[4].z, -soil.plastic[4], 1e-6);
  EXPECT_NEAR(soil.fresh_height(4), 0, 1e-6);
  EXPECT_EQ(soil.plastic[3], 0);
}

TEST(ForcesYield, SoilPulledBeyondItsCohesionFollows) {
  EXPECT_EQ(ground_after({0, 0, 0.5e-3f}, firm_soil()).rest[4].z, 0);
  EXPECT_NEAR(ground_after({0, 0, 0.5f}, firm_soil()).rest[4].z, 0.5 - 100 / 1e5, 1e-6);
}

TEST(ForcesYield, SoilShearedTooFarSlides) {
  EXPECT_EQ(ground_after({0.02f, 0, 0}, firm_soil()).rest[4].x, 0);
  EXPECT_NEAR(ground_after({0.5f, 0, 0}, firm_soil()).rest[4].x, 0.5 - 0.03, 1e-5);
}

}  // namespace
}  // namespace divot::forces
