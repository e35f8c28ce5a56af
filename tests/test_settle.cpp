// Particles become terrain again: places handed over, elastic rest given up, soil thrown and landed, sleep.
#include "settle/settle.h"
#include "support.h"

namespace divot::settle {
namespace {

using test::Sheet;

Sheet small_sheet() { return test::make_sheet({.columns = 5, .rows = 5, .spacing = 1}); }

struct Settle {
  std::vector<state::Blast> blasts;
  std::vector<state::Body> bodies = std::vector<state::Body>(1);
  Stillness stillness{0.01f, 0, 3};
  Moved moved;
  Scratch scratch;
  void operator()(Sheet& s, double time = 0) {
    update(s.particles, s.soil, s.surface, blasts, bodies, s.media, stillness, {time, 1.0 / 60, 9.81}, true, moved,
           scratch, Jobs(1));
  }
};

TEST(Settle, TheSurfaceGoesWithItsParticlesAndSaysSo) {
  Sheet s = small_sheet();
  s.particles.hold[3] = Hold::anchor, s.particles.hold[7] = Hold::carried;
  s.particles.z[3] -= 1, s.particles.z[7] -= 0.5f, s.particles.z[12] -= 0.2f;
  Settle step;
  step(s);
  EXPECT_EQ(s.surface.position[3].z, 0) << "anchors do not move the ground";
  EXPECT_EQ(s.surface.position[7].z, -0.5f);
  EXPECT_EQ(s.surface.position[12].z, -0.2f);
  EXPECT_EQ(step.moved.vertices, (std::vector<std::uint32_t>{7, 12}));
  EXPECT_FLOAT_EQ(step.moved.distance, 0.5f);
  EXPECT_FLOAT_EQ(step.moved.free_distance, 0.2f);
  step(s);
  EXPECT_TRUE(step.moved.vertices.empty());
}

TEST(Settle, WhatIsStillLongEnoughSleeps) {
  Sheet s = small_sheet();
  s.particles.vx[0] = 1;
  s.particles.hold[1] = Hold::carried;
  Settle step;
  step(s), step(s);
  EXPECT_EQ(s.particles.hold[12], Hold::free);
  s.particles.vz[12] = -1;  // it stirs once more
  step(s);
  EXPECT_EQ(s.particles.hold[12], Hold::free);
  EXPECT_EQ(s.particles.hold[13], Hold::asleep);
  EXPECT_EQ(s.particles.hold[0], Hold::free) << "it moves";
  EXPECT_EQ(s.particles.hold[1], Hold::carried) << "a body has it";
}

TEST(Settle, SleepersGiveUpTheirElasticRest) {
  Sheet s = small_sheet();
  const std::uint32_t column = s.particles.column[12];
  s.soil.plastic[column] = 0.3f, s.soil.rest[column].z = -0.3f;
  s.particles.z[12] = -0.4f, s.particles.x[12] += 0.05f, s.particles.vz[12] = 0.001f, s.particles.flow_rate[12] = 2;
  Settle step{.stillness = {0.01f, 0, 1}};
  const float fresh = s.soil.fresh_height(column);
  step(s);
  EXPECT_EQ(s.particles.hold[12], Hold::asleep);
  EXPECT_EQ(s.soil.rest[column], s.surface.position[12]);
  EXPECT_FLOAT_EQ(s.soil.rest[column].z, -0.4f);
  EXPECT_FLOAT_EQ(s.soil.plastic[column], 0.4f) << "Bekker's curve is re-entered where the soil stands";
  EXPECT_FLOAT_EQ(s.soil.fresh_height(column), fresh);
  EXPECT_EQ(s.particles.velocity(12), Vec3{});
  EXPECT_EQ(s.particles.flow_rate[12], 0);
}

// What a blast drives down in a step: a share of it lands, on awake and on resting ground alike.
TEST(Settle, ThrownSoilLandsAndNoneIsLost) {
  Sheet s = small_sheet();
  s.soil.particle[s.particles.column[2]] = kNone;  // landing ground that rests
  s.particles.hold[2] = Hold::anchor;
  Settle step;
  double sunk = 0;
  step.blasts.push_back({.start = 0, .pulse = 10});
  state::Blast& blast = step.blasts[0];
  for (const std::uint32_t i : {11u, 12u, 13u}) {
    blast.column.push_back(s.particles.column[i]);
    blast.thrown.push_back(0.185f);
    s.particles.flow_rate[i] = 1;
    s.particles.z[i] -= 0.5f;
    sunk += 0.5 * s.soil.area[s.particles.column[i]];
  }
  double area = 0;
  for (const std::uint32_t i : {2u, 22u}) {
    blast.landing.push_back(s.particles.column[i]);
    area += s.soil.area[s.particles.column[i]];
  }
  blast.landing_height.assign(2, static_cast<float>(1 / area));
  step(s);

  const double height = sunk * 0.185 / area;
  EXPECT_NEAR(s.surface.position[2].z, height, 1e-5);
  EXPECT_NEAR(s.surface.position[22].z, height, 1e-5);
  double added = 0;
  for (std::uint32_t c = 0; c < s.soil.size(); ++c) added += s.soil.gained[c];
  EXPECT_NEAR(added, 0, 1e-7);
  const std::uint32_t middle = s.particles.column[12];
  const double lost = 0.5 * s.soil.area[middle];
  EXPECT_NEAR(s.soil.gained[middle], -lost * 0.185, 1e-5);
  EXPECT_NEAR(s.soil.compacted[middle], lost * (1 - 0.185), 1e-5);
  EXPECT_NEAR(s.soil.rest[s.particles.column[22]].z, height, 1e-5);
}

TEST(Settle, ABlastEndsWithItsPulseAndItsFlow) {
  Sheet s = small_sheet();
  Settle step;
  step.blasts.push_back({.start = 0, .pulse = 1});
  step.blasts[0].column = {s.particles.column[12]};
  s.particles.flow_rate[12] = 1;
  s.particles.vz[12] = -1;
  step(s, 0.5);
  EXPECT_TRUE(step.blasts[0].active) << "in its pulse";
  step(s, 2);
  EXPECT_TRUE(step.blasts[0].active) << "the ground still flows";
  s.particles.vz[12] = 0;
  step(s, 2), step(s, 2), step(s, 2);
  EXPECT_FALSE(step.blasts[0].active);
}

}  // namespace
}  // namespace divot::settle
