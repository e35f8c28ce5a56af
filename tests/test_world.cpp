// The whole: the paper's scene, permanence, soil that is not lost, and the interface as a program uses it.
#include <algorithm>
#include <numeric>

#include "support.h"

namespace divot {
namespace {

using test::make_world;
using test::paper_scene;
using test::run_to;

constexpr double kDuration = 12;  // s, of the paper's scene

struct Travel {
  Vec3d end, velocity;
  double path = 0;
  std::size_t peak = 0;
};

Travel travel(const Scene& scene) {
  World world = make_world(scene);
  Travel t;
  Vec3d last = world.bodies().at(0).position;
  while (world.time() < kDuration - 0.5 * scene.dt) {
    const StepReport report = world.step();
    EXPECT_FALSE(report.not_finite) << world.time();
    const BodyView ball = world.bodies()[0];
    t.path += length(ball.position - last);
    last = ball.position;
  }
  EXPECT_TRUE(test::all_finite(world));
  t.end = last, t.velocity = world.bodies()[0].velocity, t.peak = world.peak_particles();
  return t;
}

double heading_deg(const Vec3d& v) { return test::degrees(std::atan2(v.y, v.x)); }

// ---- the paper's scene

TEST(WorldPaper, HasItsTrianglesAndItsParticles) {
  const World world = make_world(paper_scene());
  EXPECT_EQ(world.surface().triangles.size(), 3u * 2808);
  EXPECT_GE(travel(paper_scene()).peak, 98u);
}

TEST(WorldPaper, TheCraterTurnsTheBall) {
  Scene quiet = paper_scene();
  quiet.bombs.clear();
  const Travel with = travel(paper_scene()), without = travel(quiet);
  EXPECT_GT(length(without.velocity), 1) << "without the bomb it rolls on";
  double turn = std::abs(heading_deg(with.velocity) - heading_deg(without.velocity));
  turn = std::min(turn, 360 - turn);
  EXPECT_GT(turn, 10);
}

TEST(WorldPaper, HalfTheStepTakesTheBallToTheSamePlace) {
  Scene fine = paper_scene();
  fine.dt /= 2;
  const Travel a = travel(paper_scene()), b = travel(fine);
  EXPECT_LT(length(b.end - a.end), 0.05 * a.path);
}

TEST(WorldPaper, ItsCraterIsEq10s) {
  World world = make_world(paper_scene());
  run_to(world, 3);
  ASSERT_EQ(world.craters().size(), 1u);
  EXPECT_NEAR(world.craters()[0].width, 121.961, 12.2);
  EXPECT_EQ(world.craters()[0].yield, 5000);
  EXPECT_LT(length(world.craters()[0].position - Vec3d{2, 2, 0}), 0.01);
}

TEST(WorldPaper, CratersStayAndTheGroundSleeps) {
  Scene scene = paper_scene();
  scene.bodies.clear();
  World world = make_world(scene);
  run_to(world, 3);
  const double fresh = world.craters().at(0).depth;
  run_to(world, 63);
  EXPECT_GE(world.craters()[0].depth, 0.95 * fresh);
  EXPECT_EQ(test::awake(world), 0u);
  EXPECT_EQ(world.particles().vertices.size(), 0u);
}

// ---- permanence and soil

Scene rut_scene() {
  Scene scene;
  scene.terrain = {.shape = GridTerrain{.columns = 81, .rows = 31, .spacing = 0.15}, .material = "mud"};
  scene.bodies = {{.name = "wheel",
                   .shape = Sphere{0.6},
                   .mass = 500,
                   .position = {-3, 0, 0},
                   .above_ground = true,
                   .velocity = {4, 0, 0}}};
  return scene;
}

// Deepest sinkage across x, m.
double rut_depth(const World& world, double x) {
  double deepest = 0;
  for (double y = -0.6; y <= 0.6; y += 0.02) deepest = std::max(deepest, -world.ground_height(x, y));
  return deepest;
}

TEST(World, RutsStay) {
  World world = make_world(rut_scene());
  run_to(world, 1);
  const double x = -2.7, fresh = rut_depth(world, x);
  ASSERT_GT(world.bodies()[0].position.x, x + 0.4) << "the wheel is past";
  EXPECT_GT(fresh, 0.02);
  run_to(world, 61);
  EXPECT_GE(rut_depth(world, x), 0.95 * fresh);
}

TEST(World, NoSoilIsLost) {
  World rut = make_world(rut_scene());
  run_to(rut, 2);
  EXPECT_GT(rut.soil_volume().displaced, 0.01);
  EXPECT_LT(rut.soil_volume().relative_error(), 0.01);

  World craters = make_world(paper_scene());
  run_to(craters, 5);
  const SoilVolume soil = craters.soil_volume();
  EXPECT_GT(soil.displaced, 1e4);
  EXPECT_GT(soil.deposited, 0);
  EXPECT_LT(soil.relative_error(), 0.01);
}

TEST(World, AtRestNothingMovesAndNothingCosts) {
  Scene scene;
  World world = make_world(scene);
  const std::uint64_t hash = world.state_hash();
  run_to(world, 1);
  EXPECT_EQ(world.state_hash(), hash);
  EXPECT_EQ(world.peak_particles(), 0u);
  EXPECT_EQ(world.soil_volume().displaced, 0);
  EXPECT_EQ(world.soil_volume().relative_error(), 0);
}

TEST(World, WithoutGroundTheSheetStillComesToRest) {
  Scene scene = paper_scene();
  scene.materials[0].ground = false;
  scene.bodies.clear();
  World world = make_world(scene);
  run_to(world, 20);
  EXPECT_TRUE(test::all_finite(world));
}

// ---- the interface

TEST(World, DirtyRangesCoverEveryVertexThatMoved) {
  World world = make_world(paper_scene());
  EXPECT_TRUE(world.take_dirty().empty());
  const auto positions = [&] {
    return std::vector<Vec3>(world.surface().positions.begin(), world.surface().positions.end());
  };
  std::vector<Vec3> before = positions();
  std::size_t moved = 0, sent = 0;
  for (int frame = 0; frame < 60; ++frame) {
    for (int k = 0; k < 3; ++k) world.step();
    const std::vector<DirtyRange> ranges = world.take_dirty();
    std::vector<bool> dirty(before.size(), false);
    std::uint32_t last = 0;
    for (const auto& [first, end] : ranges) {
      ASSERT_TRUE(first < end && end <= before.size());
      ASSERT_TRUE(&ranges.front() == &ranges[0] && (first > last || last == 0)) << "ascending and disjoint";
      std::fill(dirty.begin() + first, dirty.begin() + end, true);
      last = end, sent += end - first;
    }
    const std::vector<Vec3> after = positions();
    for (std::size_t v = 0; v < after.size(); ++v) {
      moved += after[v] != before[v];
      ASSERT_TRUE(dirty[v] || after[v] == before[v]) << "vertex " << v;
    }
    before = after;
  }
  EXPECT_GT(moved, 0u);
  EXPECT_LT(sent, 60 * before.size()) << "not everything each time";
  EXPECT_TRUE(world.take_dirty().empty());
}

TEST(World, SinkageIsWhatTheSurfaceLost) {
  World world = make_world(paper_scene());
  const std::vector<Vec3> before(world.surface().positions.begin(), world.surface().positions.end());
  run_to(world, 2);
  float deepest = 0;
  for (std::uint32_t v = 0; v < before.size(); ++v) {
    ASSERT_FLOAT_EQ(world.sinkage(v), before[v].z - world.surface().positions[v].z);
    deepest = std::max(deepest, world.sinkage(v));
  }
  EXPECT_NEAR(deepest, world.craters().at(0).depth, 1e-4);
}

TEST(World, GroundHeightFollowsTheTerrain) {
  Scene scene;
  scene.terrain.shape = GridTerrain{
      .columns = 21, .rows = 11, .spacing = 2, .height = [](double x, double y) { return 0.1 * x - 0.2 * y; }};
  const World world = make_world(scene);
  test::Random random(9);
  for (int k = 0; k < 200; ++k) {
    const double x = random.in(-20.0, 20.0), y = random.in(-10.0, 10.0);
    EXPECT_NEAR(world.ground_height(x, y), 0.1 * x - 0.2 * y, 1e-5);
  }
  EXPECT_TRUE(std::isnan(world.ground_height(20.1, 0)));
  EXPECT_TRUE(std::isnan(world.ground_height(0, -11)));
}

TEST(World, SpawnedBodiesAreThoseOfTheScene) {
  Scene scene = paper_scene();
  const BodySettings ball = scene.bodies[0];
  scene.bodies.clear();
  World spawned = make_world(scene), placed = make_world(paper_scene());
  const auto id = spawned.spawn(ball);
  ASSERT_TRUE(id.has_value());
  EXPECT_EQ(id->value, 0u);
  run_to(spawned, 2), run_to(placed, 2);
  EXPECT_EQ(spawned.state_hash(), placed.state_hash());
  const auto second = spawned.spawn({.name = "second", .position = {0, 0, 200}});
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ(second->value, 1u);
  EXPECT_EQ(spawned.bodies()[1].name, "second");
}

TEST(World, AddedBombsAreThoseOfTheScene) {
  Scene scene = paper_scene();
  const Bomb bomb = scene.bombs[0];
  scene.bombs.clear();
  World added = make_world(scene), planned = make_world(paper_scene());
  run_to(added, 0.25), run_to(planned, 0.25);
  ASSERT_TRUE(added.add_bomb(bomb).has_value());
  run_to(added, 2), run_to(planned, 2);
  EXPECT_EQ(added.state_hash(), planned.state_hash());
}

TEST(World, ABombWhoseTimeHasPassedGoesOffInTheNextStep) {
  World world = make_world(Scene{});
  run_to(world, 1);
  ASSERT_TRUE(world.add_bomb({.time = 0.2, .yield = 5000}).has_value());
  EXPECT_FALSE(world.bombs().at(0).exploded);
  EXPECT_TRUE(world.craters().empty());
  world.step();
  EXPECT_TRUE(world.bombs().at(0).exploded);
  EXPECT_EQ(world.craters().size(), 1u);
}

TEST(World, BombsGoOffInOrderOfTime) {
  Scene scene;
  scene.bombs = {{.time = 0.4, .yield = 10}, {.time = 0.1, .yield = 20}, {.time = 0.2, .yield = 30}};
  World world = make_world(scene);
  run_to(world, 0.6);
  ASSERT_EQ(world.craters().size(), 3u);
  EXPECT_EQ(world.craters()[0].yield, 20);
  EXPECT_EQ(world.craters()[2].yield, 10);
}

// Places a body so that nothing of the ground is inside it, and a bomb on the ground.
TEST(World, AboveGroundIsCountedFromTheGround) {
  Scene scene;
  scene.terrain.shape =
      GridTerrain{.columns = 41, .rows = 41, .spacing = 0.5, .height = [](double x, double) { return 3 + x; }};
  scene.bodies = {{.name = "ball", .shape = Sphere{1.5}, .position = {2, 0, 0.25}, .above_ground = true}};
  scene.bombs = {{.time = 9, .position = {-1, 0, 0.5}, .above_ground = true}};
  const World world = make_world(scene);
  EXPECT_NEAR(world.bombs()[0].position.z, 2.5, 1e-5);
  const Vec3d centre = world.bodies()[0].position - Vec3d{0, 0, 0.25};
  EXPECT_NEAR((centre.z - centre.x - 3) / std::sqrt(2), 1.5, 1e-5) << "it touches the slope";
}

std::string first_error(const auto& result) { return result ? "none" : result.error().front().text(); }

TEST(World, WrongInputIsRefusedInWords) {
  Scene scene = paper_scene();
  scene.dt = -1;
  scene.bodies[0].mass = 0;
  const auto world = World::create(scene);
  ASSERT_FALSE(world.has_value());
  EXPECT_EQ(world.error().size(), 2u) << "every problem, not only the first";

  World good = make_world(paper_scene());
  const std::uint64_t hash = good.state_hash();
  EXPECT_NE(first_error(good.spawn({.name = "x", .mass = -1})).find("mass"), std::string::npos);
  EXPECT_NE(first_error(good.spawn({.name = "x", .shape = Sphere{std::nan("")}})).find("radius"), std::string::npos);
  EXPECT_NE(first_error(good.spawn({.name = "far", .position = {1e4, 0, 0}, .above_ground = true})).find("no ground"),
            std::string::npos);
  EXPECT_NE(first_error(good.add_bomb({.yield = 0})).find("yield"), std::string::npos);
  EXPECT_NE(first_error(good.add_bomb({.position = {0, 1e4, 0}, .above_ground = true})).find("no ground"),
            std::string::npos);
  EXPECT_EQ(good.state_hash(), hash);
  EXPECT_EQ(good.bodies().size(), 1u);
  EXPECT_EQ(good.bombs().size(), 1u);

  Scene unknown;
  unknown.terrain.material = "cheese";
  EXPECT_NE(first_error(World::create(unknown)).find("cheese"), std::string::npos);
}

TEST(World, TheSameSceneTwiceIsTheSameRun) {
  World a = make_world(paper_scene()), b = make_world(paper_scene());
  EXPECT_EQ(a.state_hash(), b.state_hash());
  run_to(a, 4), run_to(b, 4);
  EXPECT_EQ(a.state_hash(), b.state_hash());
}

TEST(World, TwoSideBySideDoNotDisturbEachOther) {
  World alone_a = make_world(paper_scene()), alone_b = make_world(rut_scene());
  for (int k = 0; k < 90; ++k) alone_a.step();
  for (int k = 0; k < 90; ++k) alone_b.step();
  const auto jobs = std::make_shared<const Jobs>(2);
  auto a = World::create(paper_scene(), jobs), b = World::create(rut_scene(), jobs);
  ASSERT_TRUE(a && b);
  for (int k = 0; k < 90; ++k) a->step(), b->step();
  EXPECT_EQ(a->state_hash(), alone_a.state_hash());
  EXPECT_EQ(b->state_hash(), alone_b.state_hash());
}

TEST(World, MovedWorldsGoOn) {
  World a = make_world(paper_scene()), b = make_world(paper_scene());
  run_to(a, 1), run_to(b, 1);
  World moved = std::move(a);
  run_to(moved, 2), run_to(b, 2);
  EXPECT_EQ(moved.state_hash(), b.state_hash());
}

TEST(World, ViewsAndCountsAgree) {
  World world = make_world(paper_scene());
  run_to(world, 1);
  EXPECT_EQ(world.steps(), 60u);
  EXPECT_NEAR(world.time(), 1, 1e-9);
  EXPECT_EQ(world.scene().bodies.size(), 1u);
  EXPECT_EQ(world.materials()[0].name, "soil");
  const ParticleView p = world.particles();
  ASSERT_GT(p.vertices.size(), 0u);
  EXPECT_TRUE(std::is_sorted(p.vertices.begin(), p.vertices.end()));
  for (std::size_t i = 0; i < p.vertices.size(); ++i) {
    EXPECT_EQ(world.surface().positions[p.vertices[i]], (Vec3{p.x[i], p.y[i], p.z[i]}));
  }
  ASSERT_EQ(world.stages().size(), 9u);
  for (const StageTime& stage : world.stages()) EXPECT_GE(stage.ms, 0) << stage.name;
  EXPECT_GE(world.stages()[5].calls, 30u) << "nothing moves before the bomb";
  EXPECT_EQ(world.updates().missed_pairs, 0u);
  ASSERT_TRUE(world.raster().has_value());
  EXPECT_EQ(world.raster()->columns, 37u);
  EXPECT_EQ(world.raster()->heights.size(), 37u * 40);
}

// As in the README: a kilogram of TNT on dry sand.
TEST(World, ReadmeExample) {
  Scene scene;
  scene.terrain = {.shape = GridTerrain{.columns = 101, .rows = 101, .spacing = 0.1}, .material = "dry_sand"};
  scene.bombs = {{.time = 0.1, .yield = 0.001}};
  auto world = World::create(scene);
  ASSERT_TRUE(world.has_value());
  while (world->time() < 0.5) world->step();
  EXPECT_NEAR(world->craters().front().width, 2 * 0.297, 0.15 * 2 * 0.297);
}

}  // namespace
}  // namespace divot
