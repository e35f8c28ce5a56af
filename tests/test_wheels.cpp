// Wheels on a rail: what rolling, skidding and driving do in soft ground.
#include "support.h"

namespace divot {
namespace {

struct Rolled {
  double sinkage = 0, slip = 0, pull = 0;  // m; of the rim against the way; N
};

// Means over the second half of 2 m of dry sand, under 3 kN. `spin`: rad/s; 0: it turns freely.
Rolled roll(double speed, double spin, double dt = 1.0 / 60) {
  constexpr double kRadius = 0.4, kSpacing = 0.04;
  Scene scene;
  scene.dt = dt;
  scene.terrain = {.shape = GridTerrain{.columns = 91, .rows = 41, .spacing = kSpacing}, .material = "dry_sand"};
  scene.bodies = {{.name = "carriage", .shape = Box{{0.3, 0.3, 0.1}}, .mass = 100, .position = {-1, 0.01, 1}},
                  {.name = "wheel", .shape = Cylinder{kRadius, 0.3}, .mass = 30, .position = {-1, 0.01, kRadius}}};
  Joint rail{.type = JointType::slider, .second = "carriage", .axis = {1, 0, 0}, .motor_force = 1e6};
  rail.motor_speed = Profile{{{1, 0}, {1.2, speed}}};
  Joint hub{.type = JointType::wheel, .first = "carriage", .second = "wheel", .stiffness = 1, .damping = 200};
  hub.preload = 2700;
  if (spin > 0) hub.motor_speed = Profile{{{1, 0}, {1.2, spin}}}, hub.motor_force = 1e6;
  scene.joints = {rail, hub};
  World world = test::make_world(scene);
  test::run_to(world, 1.1 + 1 / speed);
  Rolled mean;
  int count = 0;
  for (; world.time() < 1.1 + 2 / speed; ++count) {
    world.step();
    mean.sinkage += kRadius - world.bodies()[1].position.z, mean.pull -= world.joints()[0].motor_force;
    mean.slip += 1 - speed / (kRadius * world.joints()[1].speed);
  }
  return {mean.sinkage / count, mean.slip / count, mean.pull / count};
}

// A load that moves along radiates no waves.
TEST(Wheels, SinkAsDeepAtAnySpeedAndStep) {
  const double slow = roll(0.3, 0).sinkage;
  EXPECT_GT(slow, 0.04);
  EXPECT_NEAR(roll(2, 0).sinkage, slow, 0.1 * slow);
  EXPECT_NEAR(roll(2, 0, 1.0 / 240).sinkage, slow, 0.1 * slow);
}

TEST(Wheels, SkidWhenTowedAndPullOnlyWithSlip) {
  const Rolled towed = roll(0.5, 0), even = roll(0.5, 0.5 / 0.4), slips = roll(0.5, 0.5 / 0.4 / 0.7);
  EXPECT_LT(towed.slip, -0.02);
  EXPECT_GT(towed.slip, -0.15);
  EXPECT_LT(towed.pull, -300);
  EXPECT_GT(even.pull, towed.pull);
  EXPECT_LT(even.pull, 300);
  EXPECT_GT(slips.pull, 600);
}

}  // namespace
}  // namespace divot
