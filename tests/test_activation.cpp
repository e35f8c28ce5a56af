// Which vertices are particles: anchors round the awake, order, sleep, and indices that agree.
#include <algorithm>
#include <set>

#include "activation/activation.h"
#include "support.h"

namespace divot::activation {
namespace {

struct Ground {
  explicit Ground(int size) : surface(test::make_surface({.columns = size, .rows = size, .spacing = 1})) {}

  bool wake(std::vector<std::uint32_t> vertices) { return update(particles, soil, surface, media, vertices, scratch); }

  std::set<std::uint32_t> with(Hold hold) const {
    std::set<std::uint32_t> found;
    for (std::size_t i = 0; i < particles.size(); ++i)
      if (particles.hold[i] == hold) found.insert(particles.vertex[i]);
    return found;
  }

  std::size_t row(std::uint32_t vertex) const { return soil.particle[surface.column[vertex]]; }

  state::Surface surface;
  state::Soil soil;
  state::Particles particles;
  std::vector<laws::Medium> media = {laws::make_medium(Material{})};
  Scratch scratch;
};

// What must be true after every update, whatever was woken.
void expect_consistent(Ground& g) {
  state::Particles& p = g.particles;
  p.for_each_array([&](const auto& array) { ASSERT_EQ(array.size(), p.size()); });
  ASSERT_TRUE(std::is_sorted(p.vertex.begin(), p.vertex.end()));
  ASSERT_EQ(std::adjacent_find(p.vertex.begin(), p.vertex.end()), p.vertex.end());

  // Columns and particles point at each other; columns without a particle say so.
  std::size_t awake_columns = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    ASSERT_EQ(g.surface.column[p.vertex[i]], p.column[i]);
    ASSERT_EQ(g.soil.vertex[p.column[i]], p.vertex[i]);
    ASSERT_EQ(g.soil.particle[p.column[i]], i);
  }
  for (const std::uint32_t particle : g.soil.particle) awake_columns += particle != kNone;
  ASSERT_EQ(awake_columns, p.size());

  // Anchors are the neighbours of the awake that are not awake themselves, all of them and no others.
  std::set<std::uint32_t> awake = g.with(Hold::free), ring;
  awake.merge(g.with(Hold::carried));
  for (const std::uint32_t v : awake)
    g.surface.mesh.for_each_neighbour(v, [&](std::uint32_t u) {
      if (!awake.contains(u)) ring.insert(u);
    });
  ASSERT_EQ(g.with(Hold::anchor), ring);
  ASSERT_TRUE(g.with(Hold::asleep).empty());
}

TEST(Activation, WakesWithARingOfAnchors) {
  Ground g(7);
  EXPECT_TRUE(g.wake({24, 24, 25}));
  expect_consistent(g);
  EXPECT_EQ(g.with(Hold::free), (std::set<std::uint32_t>{24, 25}));
  EXPECT_EQ(g.with(Hold::anchor).size(), 8u);  // whichever way the diagonals run
  for (std::size_t i = 0; i < g.particles.size(); ++i) {
    EXPECT_EQ(g.particles.position(i), g.surface.position[g.particles.vertex[i]]);
    EXPECT_EQ(g.particles.velocity(i), Vec3{});
    EXPECT_FLOAT_EQ(g.particles.mass[i], g.media[0].areal_mass * g.soil.cell[g.particles.column[i]]);
  }
}

TEST(Activation, NothingNewChangesNothing) {
  Ground g(7);
  EXPECT_FALSE(g.wake({}));
  EXPECT_TRUE(g.wake({24}));
  EXPECT_FALSE(g.wake({}));
  EXPECT_FALSE(g.wake({24, 24}));
}

TEST(Activation, TheAwakeKeepTheirMotionWhenOthersWake) {
  Ground g(7);
  g.wake({24});
  const std::size_t before = g.row(24);
  g.particles.set_position(before, {0.1f, 0.2f, -0.3f});
  g.particles.set_velocity(before, {1, 2, 3});
  g.particles.flow_rate[before] = 4, g.particles.held_pull[before] = 5, g.particles.still_steps[before] = 6;
  g.particles.hold[before] = Hold::carried;
  EXPECT_TRUE(g.wake({0, 48, 17}));
  expect_consistent(g);
  const std::size_t after = g.row(24);
  EXPECT_NE(after, before);
  EXPECT_EQ(g.particles.position(after), (Vec3{0.1f, 0.2f, -0.3f}));
  EXPECT_EQ(g.particles.velocity(after), (Vec3{1, 2, 3}));
  EXPECT_EQ(g.particles.flow_rate[after], 4);
  EXPECT_EQ(g.particles.held_pull[after], 5);
  EXPECT_EQ(g.particles.still_steps[after], 6);
  EXPECT_EQ(g.particles.hold[after], Hold::carried);
}

TEST(Activation, SleepersLeaveOrStandAsAnchors) {
  Ground g(9);
  g.wake({40, 41, 42});
  g.particles.hold[g.row(40)] = Hold::asleep;
  EXPECT_TRUE(g.wake({}));
  expect_consistent(g);
  EXPECT_EQ(g.with(Hold::free), (std::set<std::uint32_t>{41, 42}));
  EXPECT_TRUE(g.with(Hold::anchor).contains(40));
  for (const std::uint32_t v : {41, 42}) g.particles.hold[g.row(v)] = Hold::asleep;
  EXPECT_TRUE(g.wake({}));
  EXPECT_EQ(g.particles.size(), 0u);
  for (const std::uint32_t particle : g.soil.particle) EXPECT_EQ(particle, kNone);
  EXPECT_GT(g.soil.size(), 3u) << "columns stay";
}

TEST(Activation, WhoSleepsAndIsWokenIsAwakeAtRest) {
  Ground g(7);
  g.wake({24});
  g.particles.hold[g.row(24)] = Hold::asleep;
  g.particles.still_steps[g.row(24)] = 9;
  EXPECT_TRUE(g.wake({24}));
  expect_consistent(g);
  EXPECT_EQ(g.particles.hold[g.row(24)], Hold::free);
  EXPECT_EQ(g.particles.still_steps[g.row(24)], 0);
}

TEST(Activation, AnchorsWakeFromWhereTheyStand) {
  Ground g(7);
  g.wake({24});
  EXPECT_TRUE(g.wake({25}));
  expect_consistent(g);
  EXPECT_EQ(g.particles.hold[g.row(25)], Hold::free);
  EXPECT_EQ(g.particles.position(g.row(25)), g.surface.position[25]);
}

// Waking and sleeping at random, at the border too.
TEST(Activation, StaysConsistentWhateverWakesAndSleeps) {
  Ground g(40);
  test::Random random(3);
  for (int step = 0; step < 150; ++step) {
    std::vector<std::uint32_t> wake;
    for (std::uint32_t k = random.below(12); k-- > 0;) wake.push_back(random.below(1600));
    for (std::size_t i = 0; i < g.particles.size(); ++i)
      if (g.particles.hold[i] == Hold::free && random.below(5) == 0) g.particles.hold[i] = Hold::asleep;
    std::set<std::uint32_t> expected = g.with(Hold::free);
    expected.insert(wake.begin(), wake.end());
    g.wake(wake);
    expect_consistent(g);
    ASSERT_EQ(g.with(Hold::free), expected);
  }
}

// Who woke first leaves no trace in the particles.
TEST(Activation, OrderOfWakingDoesNotMatter) {
  Ground a(20), b(20);
  a.wake({5, 300, 77}), a.wake({210, 6});
  b.wake({6, 77, 210}), b.wake({300, 5});
  EXPECT_EQ(a.particles.vertex, b.particles.vertex);
  EXPECT_EQ(a.particles.x, b.particles.x);
  EXPECT_EQ(a.particles.mass, b.particles.mass);
  EXPECT_EQ(a.particles.hold, b.particles.hold);
}

}  // namespace
}  // namespace divot::activation
