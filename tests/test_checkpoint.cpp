// A world that is saved and restored goes through the same bits as one that was not, and takes nothing that is no
// world.
#include "support.h"

namespace divot {
namespace {

Result<World> restored(const World& world, const Scene& scene, int threads = 1) {
  return World::restore(world.save(), scene, std::make_shared<const Jobs>(threads));
}

// At every `every`-th step up to `until` the world is left to one that was restored from it, which must save the same
// bytes and end every step with the same bits.
void expect_same_bits(const Scene& scene, int until, int every) {
  World never_cut = test::make_world(scene), world = test::make_world(scene);
  for (int step = 0; step < until; ++step) {
    if (step % every == 0) {
      const std::string bytes = world.save();
      auto next = World::restore(bytes, scene, std::make_shared<const Jobs>(2));
      ASSERT_TRUE(next) << next.error().front().text();
      EXPECT_TRUE(next->save() == bytes) << "at step " << step;
      world = std::move(*next);
    }
    world.step(), never_cut.step();
    ASSERT_EQ(world.state_hash(), never_cut.state_hash()) << "in step " << step;
  }
  EXPECT_EQ(world.updates().neighbour_rebuilds, never_cut.updates().neighbour_rebuilds);
  EXPECT_EQ(world.peak_particles(), never_cut.peak_particles());
  EXPECT_EQ(world.soil_volume().displaced, never_cut.soil_volume().displaced);
}

Scene soft(int columns, double spacing) {
  Scene scene;
  scene.terrain.shape =
      GridTerrain{.columns = columns, .rows = columns, .spacing = spacing, .height = [](double x, double y) {
                    return 0.1 * std::sin(x) * std::cos(0.7 * y);
                  }};
  scene.terrain.material = "dry_sand";
  return scene;
}

// Bodies of every shape in a heap, so that they lie on each other and roll off.
Scene heap() {
  Scene scene = soft(81, 0.1);
  const Compound hammer{{{Box{{0.2, 0.2, 0.2}}, {0, 0, 0}, {}}, {Cylinder{0.05, 0.6}, {0, 0.3, 0}, {}}}};
  const Hull wedge{.points = {{-0.2, -0.2, -0.1}, {0.2, -0.2, -0.1}, {0, 0.2, -0.1}, {0, 0, 0.25}}};
  const Shape shapes[] = {
      Box{{0.4, 0.3, 0.2}}, Cylinder{0.15, 0.3}, Capsule{0.1, 0.3}, Cone{0.2, 0.3}, Sphere{0.2}, hammer, wedge};
  for (int k = 0; k < 14; ++k)
    scene.bodies.push_back({.name = "body " + std::to_string(k),
                            .shape = shapes[k % 7],
                            .mass = 10.0 + k,
                            .position = {0.15 * (k % 3), 0.1 * (k % 2), 0.1 + 0.32 * k},
                            .above_ground = true,
                            .rotation_deg = {10.0 * k, 0, 25.0 * k}});
  return scene;
}

// A cart on sprung wheels that is driven and steered.
Scene cart() {
  Scene scene = soft(81, 0.1);
  scene.bodies.push_back({.name = "frame",
                          .shape = Box{{1.2, 0.6, 0.2}},
                          .mass = 120,
                          .position = {0, 0, 0.4},
                          .above_ground = true,
                          .assembly = "cart"});
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5}) {
      const std::string name = "wheel " + std::to_string(scene.bodies.size());
      scene.bodies.push_back({.name = name,
                              .shape = Cylinder{0.25, 0.15},
                              .mass = 10,
                              .position = {x, y, 0},
                              .above_ground = true,
                              .assembly = "cart"});
      Joint wheel{.name = name, .type = JointType::wheel, .first = "frame", .second = name};
      wheel.stiffness = 8000, wheel.damping = 500, wheel.preload = 300;
      wheel.motor_speed = {{{0, 0}, {1, 6}}}, wheel.motor_force = 80;
      if (x > 0) wheel.steering_deg = {{{0, 0}, {1, 20}}};
      scene.joints.push_back(wheel);
    }
  return scene;
}

TEST(Checkpoint, ThePapersSceneGoesOnWithTheSameBits) { expect_same_bits(test::paper_scene(), 150, 17); }

TEST(Checkpoint, TheModelOfThePaperGoesOnWithTheSameBits) {
  Scene scene = test::paper_scene();
  scene.solver.blast = Blast::paper;
  scene.solver.cohesion = Cohesion::mass_spring;
  scene.solver.neighbours = Neighbours::kd_tree;
  scene.solver.neighbour_update = {UpdatePolicy::Kind::every, 3};
  scene.solver.bvh_update = {UpdatePolicy::Kind::every_step, 1};
  expect_same_bits(scene, 60, 7);
}

TEST(Checkpoint, BodiesOnEachOtherGoOnWithTheSameBits) { expect_same_bits(heap(), 120, 5); }

TEST(Checkpoint, JointsGoOnWithTheSameBits) { expect_same_bits(cart(), 90, 7); }

TEST(Checkpoint, BrokenCrustsAndCratersGoOnWithTheSameBits) {
  Scene scene = soft(61, 0.25);
  Material road = *find_preset("asphalt");
  road.name = "road", road.over = "clay_wet", road.over_thickness = 0.05;
  scene.materials = {road};
  scene.terrain.material = "road";
  scene.bombs = {{.time = 0.05, .position = {1, 0, 0}, .above_ground = true, .yield = 0.002},
                 {.time = 0.3, .position = {-2, 1, 0}, .above_ground = true, .yield = 0.004}};
  scene.bodies = {{.name = "ball", .shape = Sphere{0.5}, .mass = 4000, .position = {2, 2, 3}, .above_ground = true}};
  expect_same_bits(scene, 80, 9);
}

// What was added while the world ran is part of it.
TEST(Checkpoint, WhatWasAddedLaterIsThere) {
  const Scene scene = soft(61, 0.1);
  World world = test::make_world(scene);
  for (int k = 0; k < 5; ++k) world.step();
  ASSERT_TRUE(world.spawn({.name = "late", .shape = Box{{0.3, 0.3, 0.3}}, .mass = 50, .position = {0, 0, 1}}));
  ASSERT_TRUE(world.add_joint({.type = JointType::spring, .second = "late", .stiffness = 100}));
  world.set_motor({0}, 0.5, 20);
  ASSERT_TRUE(world.add_bomb({.time = 0.2, .position = {1, 1, 0}, .above_ground = true, .yield = 1e-4}));
  ASSERT_TRUE(world.push_ground({.position = {-1, -1, 0}, .radius = 0.5, .velocity = {1, 0, 2}}));
  auto other = restored(world, scene);
  ASSERT_TRUE(other) << other.error().front().text();
  for (int k = 0; k < 40; ++k) world.step(), other->step();
  EXPECT_EQ(other->state_hash(), world.state_hash());
  EXPECT_EQ(other->bodies().at(0).name, "late");
  EXPECT_TRUE(other->bombs().at(0).exploded);
}

TEST(Checkpoint, RefusesAnotherScene) {
  const Scene scene = heap();
  World world = test::make_world(scene);
  world.step();
  Scene heavier = scene, steeper = scene, longer = scene;
  heavier.bodies[3].mass += 1;
  std::get<GridTerrain>(steeper.terrain.shape).height = [](double x, double) { return 0.1 * x; };
  longer.duration *= 2, longer.output.every = 0.5;
  const auto other_bodies = restored(world, heavier), other_ground = restored(world, steeper);
  ASSERT_FALSE(other_bodies);
  EXPECT_EQ(other_bodies.error()[0].text(),
            "the scene is not the one whose world was saved; only duration and output may differ");
  ASSERT_FALSE(other_ground);
  EXPECT_EQ(other_ground.error()[0].key, "terrain");
  EXPECT_TRUE(restored(world, longer));
}

// Whatever the bytes are, they are refused or make a world that runs.
TEST(Checkpoint, TakesNoHarmFromDamagedBytes) {
  const Scene scene = cart();
  World world = test::make_world(scene);
  for (int k = 0; k < 20; ++k) world.step();
  const std::string whole = world.save();
  for (const std::size_t size : {std::size_t{0}, std::size_t{7}, whole.size() / 2, whole.size() - 1})
    EXPECT_FALSE(World::restore(std::string_view(whole).substr(0, size), scene)) << size;
  EXPECT_FALSE(World::restore(whole + "x", scene));

  test::Random random(5);
  int refused = 0;
  for (int round = 0; round < 300; ++round) {
    std::string bytes = whole;
    // Past the fingerprints, which refuse nearly everything.
    for (int k = 0; k < 1 + round % 4; ++k)
      bytes[16 + random.below(bytes.size() - 16)] = static_cast<char>(random.below(256));
    auto other = World::restore(bytes, scene);
    refused += !other;
    if (!other) continue;
    for (int k = 0; k < 2; ++k) other->step();
    EXPECT_TRUE(test::all_finite(*other)) << round;
  }
  EXPECT_GT(refused, 20);
}

}  // namespace
}  // namespace divot
