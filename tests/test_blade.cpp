// Blades: soil that is pushed on piles up, resists the more the higher it stands, and runs off at the sides.
#include "laws/passive_pressure.h"
#include "support.h"

namespace divot {
namespace {

TEST(Blade, SoilResistsAWallByRankinesPressure) {
  Material soil;
  soil.density = 1600, soil.cohesion = 0, soil.friction_angle_deg = 30;
  const laws::Medium sand = laws::make_medium(soil);
  EXPECT_NEAR(laws::passive_force(sand, 0.5, 0, 9.81), 0.5 * 1600 * 9.81 * 0.25 * 3, 1);
  soil.cohesion = 5000;
  const laws::Medium clay = laws::make_medium(soil);
  const double weight = laws::passive_force(sand, 0.5, 0, 9.81);
  EXPECT_NEAR(laws::passive_force(clay, 0.5, 0, 9.81) - weight, 2 * 5000 * 0.5 * std::sqrt(3.0), 1);
  EXPECT_NEAR(laws::passive_force(clay, 0.5, 0.4, 9.81) - weight, 2 * 5000 * 0.1 * std::sqrt(3.0), 1);
  EXPECT_NEAR(laws::passive_force(clay, 0.5, 0.9, 9.81), weight, 1) << "what lies loose has no cohesion";
}

// A blade 2 m wide is lowered into sand by 8 cm and pushed on at 0.6 m/s.
struct Pushed {
  double force = 0, heap = 0, ahead = 0;  // N; m, highest soil before it; m^3
};
Pushed state_of(World& world) {
  Pushed now;
  constexpr int kMean = 20;
  for (int k = 0; k < kMean; ++k) {
    world.step();
    now.force += world.joints()[0].motor_force / kMean;
  }
  const double x = world.bodies()[1].position.x, cell = world.surface().spacing * world.surface().spacing;
  for (const Vec3& p : world.surface().positions)
    if (p.x > x && p.z > 0 && std::abs(p.y) < 1)
      now.heap = std::max<double>(now.heap, p.z), now.ahead += static_cast<double>(p.z) * cell;
  return now;
}

TEST(Blade, PushesAHeapAndFeelsItGrow) {
  Scene scene;
  scene.terrain = {.shape = GridTerrain{.columns = 121, .rows = 81, .spacing = 0.05}, .material = "dry_sand"};
  scene.bodies = {{.name = "machine", .shape = Box{{0.5, 0.5, 0.3}}, .mass = 5000, .position = {-2, 0.01, 2}},
                  {.name = "blade", .shape = Box{{0.12, 2, 0.9}}, .mass = 1000, .position = {-2, 0.01, 0.47}}};
  Joint drive{.type = JointType::slider, .second = "machine", .axis = {1, 0, 0}, .motor_force = 3e5};
  drive.motor_speed = Profile{{{1, 0}, {1.5, 0.6}}};
  Joint lift{.type = JointType::slider, .first = "machine", .second = "blade", .axis = {0, 0, 1}, .motor_force = 1e5};
  lift.motor_speed = Profile{{{0, -0.1}, {1, -0.1}, {1.01, 0}}};
  scene.joints = {drive, lift};
  World world = test::make_world(scene);
  test::run_to(world, 2.2);
  const Pushed first = state_of(world);
  test::run_to(world, 4);
  const Pushed second = state_of(world);
  test::run_to(world, 5.8);
  const Pushed third = state_of(world);
  EXPECT_GT(second.heap, 1.3 * first.heap);
  EXPECT_GT(third.heap, 1.1 * second.heap);
  EXPECT_LT(third.heap, 1.2);
  EXPECT_GT(second.ahead, 1.5 * first.ahead);
  EXPECT_GT(second.force, 1.05 * first.force);
  EXPECT_GT(third.force, 1.05 * second.force);
  EXPECT_NEAR(world.bodies()[1].velocity.x, 0.6, 0.05);
  // Windrows beside its track, whose floor is clean.
  const double behind = world.bodies()[1].position.x - 0.6;
  for (const double side : {-1.0, 1.0}) EXPECT_GT(world.ground_height(behind, 1.25 * side), 0.03) << side;
  EXPECT_NEAR(world.ground_height(behind, 0), -0.08, 0.02);
  EXPECT_LT(world.soil_volume().relative_error(), 1e-3);
}

// Born in the ground, a flat body would stand in soil that nobody pushed away.
TEST(Blade, WhoseFootStartsDeepInTheGroundIsRefused) {
  Scene scene;
  scene.terrain = {.shape = GridTerrain{.columns = 41, .rows = 41, .spacing = 0.1}, .material = "dry_sand"};
  scene.bodies = {{.name = "plate", .shape = Box{{2, 2, 0.4}}, .mass = 100, .position = {0, 0, 0.05}}};
  const auto world = World::create(scene);
  ASSERT_FALSE(world);
  EXPECT_NE(world.error().front().text().find("plate.position: its underside lies 0.15 m below the ground"),
            std::string::npos)
      << world.error().front().text();
  scene.bodies[0].position.z = 0.2;
  EXPECT_TRUE(World::create(scene));
}

}  // namespace
}  // namespace divot
