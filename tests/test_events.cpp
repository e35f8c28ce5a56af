// Bombs: what they push, and the craters that come of it.
#include <algorithm>

#include "events/events.h"
#include "laws/blast.h"
#include "laws/crater.h"
#include "support.h"

namespace divot::events {
namespace {

// ---- detonation alone

struct Site {
  explicit Site(const GridTerrain& grid) : surface(test::make_surface(grid)) {
    bvh.build(surface.mesh.face_count(), geometry::corners_in(surface.mesh.triangles()), surface.position, 0,
              geometry::Bvh::Order::as_numbered, Jobs(1));
  }
  state::Blast detonate(const Bomb& bomb, Blast model = Blast::scaled) {
    return events::detonate(bomb, model, {2, 1.0 / 60, 9.81}, {}, surface, soil, bvh, media, scratch);
  }
  state::Surface surface;
  state::Soil soil;
  geometry::Bvh bvh;
  std::vector<laws::Medium> media = {laws::make_medium(Material{})};
  state::RegionScratch scratch;
};

double distance(const Site& site, const state::Blast& blast, std::uint32_t column) {
  const Vec3 offset = site.soil.original[column] - blast.ground_zero;
  return std::hypot(offset.x, offset.y);
}

TEST(Events, ABombPushesTheGroundThatFailsAndLetsSoilLandAroundIt) {
  Site site({.columns = 61, .rows = 61, .spacing = 0.3});
  const state::Blast blast = site.detonate({.position = {0.05, -0.1, 0}});
  const double radius = laws::scaled_crater(1, 0, site.media[0], 9.81).radius;
  EXPECT_TRUE(blast.active);
  EXPECT_EQ(blast.start, 2);
  EXPECT_GE(blast.pulse, laws::pulse(1));
  EXPECT_LT(length(blast.direction - Vec3{0, 0, -1}), 1e-6f);

  std::size_t inside = 0;
  for (const Vec3& p : site.surface.position) inside += std::hypot(p.x - 0.05, p.y + 0.1) < radius;
  EXPECT_EQ(blast.column.size(), inside);
  for (std::size_t k = 0; k < blast.column.size(); ++k) {
    EXPECT_LE(distance(site, blast, blast.column[k]), radius);
    EXPECT_GT(blast.push[k], 0);
  }
  double landed = 0;
  for (std::size_t k = 0; k < blast.landing.size(); ++k) {
    EXPECT_GE(distance(site, blast, blast.landing[k]), 0.999 * radius);
    EXPECT_LE(distance(site, blast, blast.landing[k]), 2.15 * radius);
    landed += blast.landing_height[k] * site.soil.area[blast.landing[k]];
  }
  EXPECT_NEAR(landed, 1, 1e-4) << "all that is thrown lands";
}

TEST(Events, ThePapersModelPushesTheParticlesWithinTheWidth) {
  Site site({});
  const state::Blast blast = site.detonate({.position = {2, 2, 10}, .yield = 5000}, Blast::paper);
  EXPECT_NEAR(static_cast<double>(blast.column.size()), 98, 1);
  EXPECT_TRUE(blast.landing.empty());
  EXPECT_EQ(blast.flow_rate, 0);
  for (const std::uint32_t column : blast.column)
    EXPECT_LE(distance(site, blast, column), laws::crater_width(5000) / 2);
}

TEST(Events, BombsBesideTheTerrainOrTooHighPushNothing) {
  Site site({.columns = 21, .rows = 21, .spacing = 1});
  EXPECT_FALSE(site.detonate({.position = {30, 0, 0}}).active);
  EXPECT_FALSE(site.detonate({.position = {0, 0, 6.5}}).active);
  EXPECT_EQ(site.soil.size(), 0u);
}

TEST(Events, ToThePapersModelBelowTheGroundIsAtTheGround) {
  Site above({.columns = 21, .rows = 21, .spacing = 1}), below({.columns = 21, .rows = 21, .spacing = 1});
  EXPECT_EQ(above.detonate({.position = {0, 0, 0}}, Blast::paper).push,
            below.detonate({.position = {0, 0, -5}}, Blast::paper).push);
}

TEST(Events, OnASlopeTheGroundIsPushedAlongItsNormal) {
  Site site({.columns = 41, .rows = 41, .spacing = 0.5, .height = [](double x, double) { return 0.4 * x; }});
  const state::Blast blast = site.detonate({.position = {0, 0, 0}});
  EXPECT_LT(length(blast.direction - normalized(Vec3{0.4f, 0, -1})), 1e-4f);
}

// Half of the ground is eight times as strong: its craters are half as wide.
TEST(Events, EachSoilFailsByItsOwnStrengthAndSoilLandsAtBothEdges) {
  Site site({.columns = 81, .rows = 81, .spacing = 0.25});
  Material strong;
  strong.blast_strength *= 8;
  strong.blast_drag *= 4;
  site.media.push_back(laws::make_medium(strong));
  for (std::size_t v = 0; v < site.surface.position.size(); ++v)
    if (site.surface.position[v].x < 0) site.surface.material[v] = 1;
  const state::Blast blast = site.detonate({.position = {0, 0, 0}});
  const double wide = laws::scaled_crater(1, 0, site.media[0], 9.81).radius;
  const double narrow = laws::scaled_crater(1, 0, site.media[1], 9.81).radius;
  EXPECT_NEAR(narrow, wide / 2, 0.01 * wide);
  double right = 0, left = 0, landed = 0, lip_left = 0;
  for (const std::uint32_t column : blast.column) {
    const Vec3 p = site.soil.original[column];
    (p.x < 0 ? left : right) = std::max(p.x < 0 ? left : right, std::hypot<double>(p.x, p.y));
  }
  EXPECT_NEAR(right, wide, 0.25);
  EXPECT_NEAR(left, narrow, 0.25);
  for (std::size_t k = 0; k < blast.landing.size(); ++k) {
    const Vec3 p = site.soil.original[blast.landing[k]];
    const double volume = blast.landing_height[k] * site.soil.area[blast.landing[k]];
    landed += volume;
    if (p.x < -1 && std::hypot(p.x, p.y) < 1.4 * narrow) lip_left += volume;
  }
  EXPECT_NEAR(landed, 1, 1e-4);
  EXPECT_GT(lip_left, 0.03) << "the strong side has a lip of its own, at its own edge";
}

// ---- craters

// The paper's grid scaled to a yield: eleven spacings across the crater.
double spacing_for(double yield) { return 10.9 * std::cbrt(yield / 5000); }

Scene crater_scene(double yield, double height = 0) {
  Scene scene;
  scene.terrain.shape = GridTerrain{.columns = 37, .rows = 37, .spacing = spacing_for(yield)};
  scene.bombs = {{.time = 0, .position = {0.1 * spacing_for(yield), 0, height}, .yield = yield}};
  return scene;
}

World blow(const Scene& scene, double until = 1.2) {
  World world = test::make_world(scene);
  test::run_to(world, until);
  EXPECT_TRUE(test::all_finite(world));
  return world;
}

Crater crater_of(const Scene& scene) { return blow(scene).craters().at(0); }

TEST(EventsCrater, WidthIsEq10s) {
  for (const double yield : {0.25, 1.0, 100.0, 5000.0}) {
    const Crater crater = crater_of(crater_scene(yield));
    const double expected = laws::crater_width(yield);
    EXPECT_DOUBLE_EQ(crater.paper_width, expected);
    EXPECT_NEAR(crater.width, expected, 0.1 * expected) << yield << " t";
    EXPECT_GE(crater.depth / crater.width, 0.15) << yield << " t";
    EXPECT_LE(crater.depth / crater.width, 0.30) << yield << " t";
  }
}

TEST(EventsCrater, HasALip) {
  Scene scene = crater_scene(1);
  std::get<GridTerrain>(scene.terrain.shape) = {.columns = 75, .rows = 75, .spacing = spacing_for(1) / 2};
  const World world = blow(scene);
  const Crater crater = world.craters().at(0);
  EXPECT_GE(crater.lip_height / crater.depth, 0.15);
  EXPECT_LE(crater.lip_height / crater.depth, 0.35);
  const double share = world.soil_volume().deposited / crater.volume;
  EXPECT_GE(share, 0.14);
  EXPECT_LE(share, 0.21);
}

TEST(EventsCrater, DoesNotDependOnTheSpacing) {
  Scene fine = crater_scene(100);
  auto& grid = std::get<GridTerrain>(fine.terrain.shape);
  grid = {.columns = 73, .rows = 73, .spacing = grid.spacing / 2};
  const Crater a = crater_of(crater_scene(100)), b = crater_of(fine);
  EXPECT_NEAR(b.width, a.width, 0.1 * a.width);
  EXPECT_NEAR(b.depth, a.depth, 0.1 * a.depth);
}

TEST(EventsCrater, DoesNotDependOnTheStep) {
  for (const double yield : {1.0, 5000.0}) {
    Scene fine = crater_scene(yield);
    fine.dt /= 2;
    const Crater a = crater_of(crater_scene(yield)), b = crater_of(fine);
    EXPECT_NEAR(b.width, a.width, 0.05 * a.width);
    EXPECT_NEAR(b.depth, a.depth, 0.05 * a.depth);
  }
}

TEST(EventsCrater, OfThePapersModelIsAsWideToo) {
  Scene scene = test::paper_scene();
  scene.bodies.clear();
  scene.solver.blast = Blast::paper;
  const Crater crater = crater_of(scene);
  EXPECT_NEAR(crater.width, 121.961, 12.2);
  EXPECT_GT(crater.depth, 0);
  EXPECT_LT(crater.depth, 0.5 * crater.width);
}

// The paper's other claim: what the ground is made of shows in the crater [TM 5-855-1].
TEST(EventsCrater, IsWhatWasMeasuredInItsSoil) {
  struct Soil {
    const char* name;
    double radius, depth;  // m/kg^(1/3)
  };
  for (const Soil& soil : {Soil{"dry_sand", 0.297, 0.149}, {"mud", 0.456, 0.228}}) {
    Scene scene = crater_scene(1);
    std::get<GridTerrain>(scene.terrain.shape) = {.columns = 61, .rows = 61, .spacing = 0.4};
    scene.terrain.material = soil.name;
    const Crater crater = crater_of(scene);
    EXPECT_NEAR(crater.width / 2, 10 * soil.radius, 1.5 * soil.radius) << soil.name;
    EXPECT_NEAR(crater.depth, 10 * soil.depth, 1.5 * soil.depth) << soil.name;
  }
}

TEST(EventsCrater, ShrinksWithTheHeightOfBurst) {
  Crater before = crater_of(crater_scene(1, 0));
  for (const double height : {1.0, 2.0, 3.0, 4.0}) {
    const Crater crater = crater_of(crater_scene(1, height));
    EXPECT_LT(crater.width, before.width) << height;
    EXPECT_LT(crater.depth, before.depth) << height;
    before = crater;
  }
}

TEST(EventsCrater, ABombTooHighLeavesNoMark) {
  Scene scene = crater_scene(1, 7);
  const World world = blow(scene);
  EXPECT_EQ(world.craters().at(0).width, 0);
  EXPECT_EQ(world.craters().at(0).depth, 0);
  EXPECT_EQ(world.soil_volume().displaced, 0);
  scene.bombs.clear();
  EXPECT_EQ(world.state_hash(), blow(scene).state_hash());
}

TEST(EventsCrater, ABombOutsideTheTerrainDoesNothing) {
  Scene scene = crater_scene(1);
  scene.bombs[0].position.x = 1000;
  const World world = blow(scene);
  EXPECT_TRUE(world.bombs().at(0).exploded);
  EXPECT_EQ(world.craters().at(0).width, 0);
  scene.bombs.clear();
  EXPECT_EQ(world.state_hash(), blow(scene).state_hash());
}

TEST(EventsCrater, AtTheBorderOnlyTheGroundThatIsThereMoves) {
  Scene scene = crater_scene(1);
  scene.bombs[0].position.x = 18 * spacing_for(1);
  const World world = blow(scene);
  EXPECT_GT(world.soil_volume().displaced, 1);
}

TEST(EventsCrater, TwoThatOverlapAreDeeperThanOne) {
  Scene one = crater_scene(1), two = one;
  two.bombs.push_back(one.bombs[0]);
  two.bombs[1].time = 0.5;
  two.bombs[1].position.x += 2;
  const World single = blow(one), both = blow(two);
  ASSERT_EQ(both.craters().size(), 2u);
  // The second goes off in the hole of the first and finds more ground around it than on the plain.
  const double first = single.soil_volume().displaced, all = both.soil_volume().displaced;
  EXPECT_GT(all, 1.3 * first);
  EXPECT_LT(all, 3.5 * first);
  EXPECT_GT(both.craters()[1].depth, single.craters()[0].depth);
}

// Energies add up, and not depths.
TEST(EventsCrater, TwoAtOnceMakeTheCraterOfTheirSum) {
  Scene apart = crater_scene(1), sum = apart;
  apart.bombs.push_back(apart.bombs[0]);
  apart.bombs[1].yield = 0.5;
  sum.bombs[0].yield = 1.5;
  const Crater expected = crater_of(sum);
  const World world = blow(apart);
  ASSERT_EQ(world.craters().size(), 2u);
  for (const Crater& crater : world.craters()) {
    EXPECT_NEAR(crater.depth, expected.depth, 0.01 * expected.depth);
    EXPECT_NEAR(crater.width, expected.width, 0.01 * expected.width);
    EXPECT_NEAR(crater.lip_height, expected.lip_height, 0.04 * expected.lip_height);
  }
  EXPECT_LT(std::abs(world.soil_volume().displaced - blow(sum).soil_volume().displaced),
            0.02 * blow(sum).soil_volume().displaced);
}

// While the first crater is made, the second charge still finds the ground that it was laid on.
TEST(EventsCrater, TwoNearlyAtOnceAreNearlyTheirSum) {
  Scene apart = crater_scene(1), sum = apart;
  apart.bombs.push_back(apart.bombs[0]);
  apart.bombs[1].time += 0.05;
  sum.bombs[0].yield = 2;
  const Crater expected = crater_of(sum), crater = crater_of(apart);
  EXPECT_NEAR(crater.depth, expected.depth, 0.02 * expected.depth);
  EXPECT_NEAR(crater.width, expected.width, 0.04 * expected.width);
  EXPECT_NEAR(crater.lip_height, expected.lip_height, 0.1 * expected.lip_height) << "what the first threw goes on";
}

// Which of two the scene has first makes no difference.
TEST(EventsCrater, TwoEqualChargesAtOnceMakeASymmetricCrater) {
  for (const double apart : {1.2, 3.6, 5.4}) {
    Scene scene = crater_scene(1);
    scene.bombs.push_back(scene.bombs[0]);
    scene.bombs[0].position = {-apart / 2, 0, 0}, scene.bombs[1].position = {apart / 2, 0, 0};
    const World world = blow(scene);
    const auto craters = world.craters();
    EXPECT_NEAR(craters[0].width, craters[1].width, 1e-3 * craters[0].width) << apart;
    EXPECT_NEAR(craters[0].lip_height, craters[1].lip_height, 0.01 * craters[0].lip_height) << apart;
    for (double x = 0.15; x < 8; x += 0.3)
      for (double y = -6; y < 6; y += 0.6)
        EXPECT_NEAR(world.ground_height(x, y), world.ground_height(-x, y), 0.02 * craters[0].depth) << x << ' ' << y;
  }
}

// From one crater to two as they move apart, whichever is the scene's first; a small charge hardly counts.
TEST(EventsCrater, ChargesAsideShareWhatBothBreak) {
  const double one = blow(crater_scene(1)).soil_volume().displaced;
  double last = 2.05 * one;
  for (const double apart : {0.0, 1.0, 3.0}) {
    Scene scene = crater_scene(1);
    scene.bombs.push_back(scene.bombs[0]);
    scene.bombs[1].position.x += apart;
    const double volume = blow(scene).soil_volume().displaced;
    EXPECT_LT(volume, last) << apart;
    EXPECT_GT(volume, 1.4 * one) << apart;
    last = volume + 0.02 * one;
  }
  for (const bool small_first : {false, true}) {
    Scene scene = crater_scene(1);
    scene.bombs.push_back(scene.bombs[0]);
    Bomb& small = scene.bombs[small_first ? 0 : 1];
    small.yield = 0.005;
    small.position.x += 3;
    EXPECT_NEAR(blow(scene).soil_volume().displaced, one, 0.03 * one) << small_first;
  }
}

// Down a slope along x nothing tells left from right.
TEST(EventsCrater, OnASlopeIsSymmetricAcrossIt) {
  Scene scene = crater_scene(1);
  auto& grid = std::get<GridTerrain>(scene.terrain.shape);
  grid.height = [](double x, double) { return 0.3 * x; };
  scene.bombs[0].position = {};
  const World world = blow(scene);
  const Crater crater = world.craters().at(0);
  EXPECT_NEAR(crater.width, laws::crater_width(1), 0.15 * laws::crater_width(1));
  const auto sunk = [&](double x, double y) { return 0.3 * x - world.ground_height(x, y); };
  for (double x = -3; x <= 3; x += 0.5)
    for (double y = 0.5; y <= 4; y += 0.5) EXPECT_NEAR(sunk(x, y), sunk(x, -y), 0.03 * crater.depth) << x << ' ' << y;
}

// ---- pushes

Scene calm_ground() {
  Scene scene;
  scene.terrain.shape = GridTerrain{.columns = 41, .rows = 41, .spacing = 10.9};
  return scene;
}

TEST(EventsPush, GroundMovesWithinTheRadiusAlone) {
  World world = test::make_world(calm_ground());
  ASSERT_TRUE(world.push_ground({.position = {11, 22, 500}, .radius = 60, .velocity = {0, 0, 3}}));
  world.step();
  const SurfaceView ground = world.surface();
  double highest = 0;
  for (std::uint32_t v = 0; v < ground.positions.size(); ++v) {
    const Vec3d p = to_double(ground.positions[v]) + ground.origin;
    const double r = std::hypot(p.x - 11, p.y - 22);
    highest = std::max(highest, p.z);
    if (r > 60) {
      EXPECT_EQ(p.z, 0) << r;
    }
    if (r < 50) {
      EXPECT_GT(p.z, 0) << r;
    }
  }
  // No faster than it was pushed, and slowed by no more than a step of ground and bonds.
  EXPECT_LT(highest, 3.0 / 60);
  EXPECT_GT(highest, 0.5 * 3.0 / 60);
}

TEST(EventsPush, TwoAddUpAndBadNumbersAreRefused) {
  World once = test::make_world(calm_ground()), twice = test::make_world(calm_ground());
  const GroundPush push{.radius = 100, .velocity = {0, 0, 0.01}};
  ASSERT_TRUE(once.push_ground(push));
  ASSERT_TRUE(twice.push_ground(push) && twice.push_ground(push));
  once.step(), twice.step();
  EXPECT_NEAR(twice.ground_height(0, 0), 2 * once.ground_height(0, 0), 0.02 * once.ground_height(0, 0));
  EXPECT_FALSE(once.push_ground({.radius = 0, .velocity = {0, 0, 1}}));
  EXPECT_FALSE(once.push_ground({.radius = 1, .velocity = {0, 0, NAN}}));
}

TEST(EventsCrater, BuriedIsLargerThenGone) {
  const Crater at = crater_of(crater_scene(1)), shallow = crater_of(crater_scene(1, -3));
  EXPECT_GT(shallow.width, 1.3 * at.width);
  EXPECT_GT(shallow.depth, 1.3 * at.depth);
  EXPECT_GE(shallow.lip_volume / shallow.volume, at.lip_volume / at.volume);
  EXPECT_EQ(crater_of(crater_scene(1, -15)).width, 0) << "a camouflet";
}

TEST(EventsCrater, DepthBuriesLikeAPositionBelowTheGround) {
  Scene by_place = crater_scene(1, -3), by_depth = crater_scene(1);
  by_depth.bombs[0].depth = 3;
  EXPECT_EQ(blow(by_place).state_hash(), blow(by_depth).state_hash());
}

// The volumes that rays integrate are those of the surface, whatever the slope.
TEST(EventsCrater, VolumesAreThoseOfTheSurface) {
  for (const double slope : {0.0, 0.3}) {
    Scene scene = crater_scene(1);
    auto& grid = std::get<GridTerrain>(scene.terrain.shape);
    grid.height = [=](double x, double) { return slope * x; };
    const World world = blow(scene);
    const SoilVolume soil = world.soil_volume();
    EXPECT_NEAR(world.craters()[0].volume, soil.displaced, 0.03 * soil.displaced) << slope;
    EXPECT_NEAR(world.craters()[0].lip_volume, soil.deposited, 0.1 * soil.deposited) << slope;
    EXPECT_LT(soil.relative_error(), 0.01) << slope;
  }
}

TEST(EventsCrater, OnASlopeMoreLandsDownhill) {
  Scene scene = crater_scene(1);
  auto& grid = std::get<GridTerrain>(scene.terrain.shape);
  grid.height = [](double x, double) { return 0.3 * x; };
  scene.bombs[0].position = {};
  const World world = blow(scene);
  double down = 0, up = 0;
  for (double x = 0.05; x < 9; x += 0.1)
    for (double y = -9; y < 9; y += 0.1) {
      down += std::max(0.0, world.ground_height(-x, y) + 0.3 * x);
      up += std::max(0.0, world.ground_height(x, y) - 0.3 * x);
    }
  EXPECT_GT(down, 1.2 * up);
  EXPECT_GT(up, 0);
}

// A crater beside another is as wide as it would be alone.
TEST(EventsCrater, IsMeasuredBesideAnother) {
  const Crater alone = crater_of(crater_scene(1));
  Scene scene = crater_scene(1);
  scene.bombs.push_back(scene.bombs[0]);
  scene.bombs[1].position.x += 0.8 * alone.width;  // they overlap by a fifth
  scene.bombs[1].time = 0.5;
  const World world = blow(scene, 1.8);
  for (const Crater& crater : world.craters()) EXPECT_NEAR(crater.width, alone.width, 0.12 * alone.width);
  EXPECT_LT(world.soil_volume().relative_error(), 0.01);
}

// A ball that lies on ground zero does not shelter the ground below it.
TEST(EventsCrater, ABallOnGroundZeroDoesNotHoldTheGround) {
  Scene scene = crater_scene(1);
  scene.terrain.material = "dry_sand";
  scene.bombs[0].time = 1;
  const Crater without = blow(scene, 3).craters().at(0);
  scene.bodies = {{.name = "ball", .shape = Sphere{1}, .mass = 100, .position = {}, .above_ground = true}};
  const World world = blow(scene, 3);
  // The ball dents the crater's floor when it falls into it.
  EXPECT_NEAR(world.craters().at(0).depth, without.depth, 0.1 * without.depth);
  EXPECT_NEAR(world.craters().at(0).width, without.width, 0.05 * without.width);
  EXPECT_LT(world.bodies()[0].position.z, -0.5 * without.depth + 1) << "it has fallen into the crater";
}

}  // namespace
}  // namespace divot::events
