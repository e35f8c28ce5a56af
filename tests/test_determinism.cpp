// Equal runs give equal bits: for any number of threads, neighbour structure and company.
#include "support.h"

namespace divot {
namespace {

// A crowd that falls, rolls and collides, with bombs among it.
Scene crowd() {
  Scene scene;
  scene.terrain = {
      .shape = GridTerrain{.columns = 121,
                           .rows = 121,
                           .spacing = 0.25,
                           .height = [](double x, double y) { return 0.4 * std::sin(0.5 * x) * std::cos(0.4 * y); }},
      .material = "dry_sand"};
  test::Random random(21);
  for (int k = 0; k < 200; ++k)
    scene.bodies.push_back({.name = "ball " + std::to_string(k),
                            .shape = Sphere{random.in(0.15, 0.4)},
                            .mass = random.in(5.0, 300.0),
                            .position = {random.in(-13.0, 13.0), random.in(-13.0, 13.0), random.in(0.0, 1.5)},
                            .above_ground = true,
                            .velocity = {random.in(-3.0, 3.0), random.in(-3.0, 3.0), 0}});
  scene.bombs = {{.time = 0.1, .position = {3, 2, 0}, .above_ground = true, .yield = 0.002},
                 {.time = 0.2, .position = {-4, -5, 0}, .above_ground = true, .yield = 0.001}};
  return scene;
}

std::uint64_t hash_after(const Scene& scene, int steps, int threads) {
  World world = test::make_world(scene, threads);
  for (int k = 0; k < steps; ++k) world.step();
  EXPECT_TRUE(test::all_finite(world));
  return world.state_hash();
}

TEST(Determinism, ThreadsDoNotChangeABitOfThePapersScene) {
  const std::uint64_t alone = hash_after(test::paper_scene(), 180, 1);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(hash_after(test::paper_scene(), 180, threads), alone) << threads;
}

TEST(Determinism, ThreadsDoNotChangeABitOfACrowd) {
  const std::uint64_t alone = hash_after(crowd(), 40, 1);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(hash_after(crowd(), 40, threads), alone) << threads;
}

TEST(Determinism, GridAndKdTreeGiveTheSameBits) {
  Scene by_tree = crowd();
  by_tree.solver.neighbours = Neighbours::kd_tree;
  EXPECT_EQ(hash_after(by_tree, 40, 2), hash_after(crowd(), 40, 2));
}

TEST(Determinism, TheHashTellsRunsApart) {
  Scene other = crowd();
  other.bodies[7].mass *= 1.0001;
  EXPECT_NE(hash_after(other, 40, 2), hash_after(crowd(), 40, 2));
}

// Looking at a world does not change it.
TEST(Determinism, LookingChangesNothing) {
  World seen = test::make_world(test::paper_scene());
  for (int k = 0; k < 90; ++k) {
    seen.step();
    seen.craters(), seen.soil_volume(), seen.take_dirty(), seen.ground_height(3, 4), seen.raster(), seen.stages();
  }
  EXPECT_EQ(seen.state_hash(), hash_after(test::paper_scene(), 90, 1));
}

}  // namespace
}  // namespace divot
