#include <gtest/gtest.h>

#include <cmath>

#include "viewer/camera_control.h"
#include "viewer/color_scale.h"
#include "viewer/live_world.h"
#include "viewer/pixel_share.h"
#include "viewer/stage_meter.h"
#include "viewer/toolbox.h"

namespace divot::viewer {
namespace {

LiveWorld plain() {
  Scene scene;
  scene.terrain.shape = GridTerrain{.columns = 20, .rows = 20, .spacing = 10};
  return LiveWorld::create(scene, std::make_shared<const Jobs>(1)).value();
}

TEST(LiveWorld, RunsWithTheClock) {
  LiveWorld live = plain();
  for (int i = 0; i < 100; ++i) live.advance(0.01);
  EXPECT_NEAR(live.world().time(), 1, 0.02);
  EXPECT_FALSE(live.lagging());
}

TEST(LiveWorld, SlowMotionAndPause) {
  LiveWorld live = plain();
  live.next_speed();
  for (int i = 0; i < 100; ++i) live.advance(0.01);
  EXPECT_NEAR(live.world().time(), 0.25, 0.02);
  live.toggle_pause();
  const double paused = live.world().time();
  for (int i = 0; i < 10; ++i) live.advance(0.1);
  EXPECT_EQ(live.world().time(), paused);
  EXPECT_LT(live.real_time_factor(), 0.01);
  live.step();
  EXPECT_GT(live.world().time(), paused);
}

TEST(LiveWorld, TimeLagsWhereStepsCannotFollow) {
  LiveWorld live = plain();
  live.advance(0.2);
  EXPECT_LT(live.world().time(), 0.1);
  EXPECT_TRUE(live.lagging());
  // What was not simulated is not made up for.
  for (int i = 0; i < 100; ++i) live.advance(0.01);
  EXPECT_LT(live.world().time(), 1.1);
  EXPECT_FALSE(live.lagging());
}

// A sledge on two runners, held by springs.
Scene joined_scene() {
  Scene scene;
  scene.terrain.shape = GridTerrain{.columns = 40, .rows = 40, .spacing = 1};
  scene.bodies = {{.name = "stone", .shape = Sphere{0.5}, .mass = 10, .position = {-5, 0, 2}},
                  {.name = "sledge", .shape = Box{{2, 1, 0.4}}, .mass = 100, .position = {5, 5, 1}},
                  {.name = "left", .shape = Box{{2, 0.2, 0.2}}, .mass = 5, .position = {5, 5.5, 0.5}},
                  {.name = "right", .shape = Box{{2, 0.2, 0.2}}, .mass = 5, .position = {5, 4.5, 0.5}}};
  scene.joints = {{.name = "l", .type = JointType::fixed, .first = "sledge", .second = "left"},
                  {.name = "r", .type = JointType::fixed, .first = "sledge", .second = "right"},
                  {.name = "t", .type = JointType::fixed, .first = "", .second = "sledge"}};
  return scene;
}

TEST(Toolbox, WhatIsJoinedIsDroppedAsOne) {
  World world = World::create(joined_scene(), std::make_shared<const Jobs>(1)).value();
  Toolbox tools(world);
  std::vector<std::string> offered;
  for (int i = 0; i < 4; ++i, tools.next_body()) offered.push_back(tools.body_text());
  // The stone, the sledge and two balls; the choice begins with the first ball.
  EXPECT_EQ(offered[0].substr(0, 10), "small ball");
  EXPECT_EQ(offered[2].substr(0, 5), "stone");
  EXPECT_EQ(offered[3], "sledge and 2 joined to it, 2.27 m, 110 kg");
  for (int i = 0; i < 3; ++i) tools.next_body();
  ASSERT_TRUE(tools.drop(world, -5, -8));
  ASSERT_EQ(world.bodies().size(), 7u);
  ASSERT_EQ(world.joints().size(), 5u) << "not the one with the terrain";
  const auto between = [&](std::size_t a, std::size_t b) {
    return length(world.bodies()[a].position - world.bodies()[b].position);
  };
  EXPECT_NEAR(world.bodies()[4].position.x, -5, 1e-9);
  EXPECT_NEAR(world.bodies()[4].position.y, -8, 1e-9);
  EXPECT_GT(world.bodies()[5].position.z, 0.2);
  for (int i = 0; i < 120; ++i) world.step();
  EXPECT_LT(world.bodies()[4].position.z, 0.8) << "it fell";
  for (const std::size_t runner : {5u, 6u}) EXPECT_NEAR(between(4, runner), between(1, runner - 3), 0.02);
  // Again: names and joints do not get into each other's way.
  ASSERT_TRUE(tools.drop(world, 8, -8));
  EXPECT_EQ(world.bodies().size(), 10u);
  EXPECT_EQ(world.joints().size(), 7u);
}

TEST(Toolbox, SaysWhereThereIsNoGround) {
  World world = World::create(joined_scene(), std::make_shared<const Jobs>(1)).value();
  const auto dropped = Toolbox(world).drop(world, 1000, 0);
  ASSERT_FALSE(dropped);
  EXPECT_NE(dropped.error().front().text().find("no ground"), std::string::npos);
  EXPECT_EQ(world.bodies().size(), 4u);
}

TEST(LiveWorld, RestartForgetsWhatWasAdded) {
  LiveWorld live = plain();
  const Toolbox tools(live.world());
  ASSERT_TRUE(tools.drop(live.world(), 0, 0));
  ASSERT_TRUE(tools.bomb(live.world(), 20, 0));
  for (int i = 0; i < 10; ++i) live.step();
  EXPECT_EQ(live.world().bodies().size(), 1u);
  EXPECT_TRUE(live.world().bombs().front().exploded);
  ASSERT_TRUE(live.restart());
  EXPECT_EQ(live.world().time(), 0);
  EXPECT_TRUE(live.world().bodies().empty());
  EXPECT_TRUE(live.world().bombs().empty());
}

TEST(Toolbox, YieldGoesInStepsAndStaysInRange) {
  LiveWorld live = plain();
  Toolbox tools(live.world());
  for (int i = 0; i < 100; ++i) tools.change_yield(false);
  EXPECT_DOUBLE_EQ(tools.yield(), 0.1);
  tools.change_yield(true);
  EXPECT_DOUBLE_EQ(tools.yield(), 0.2);
  for (int i = 0; i < 100; ++i) tools.change_yield(true);
  EXPECT_DOUBLE_EQ(tools.yield(), 1e5);
}

TEST(Toolbox, BallsPressIntoTheirSoilAndNotThroughIt) {
  for (const Material& soil : material_presets()) {
    Scene scene;
    scene.terrain.shape = GridTerrain{.columns = 40, .rows = 40, .spacing = 1};
    scene.terrain.material = soil.name;
    World world = World::create(scene, std::make_shared<const Jobs>(1)).value();
    const Toolbox tools(world);
    ASSERT_TRUE(tools.drop(world, 0, 0));
    for (int i = 0; i < 240; ++i) world.step();
    const BodyView body = world.bodies().front();
    EXPECT_TRUE(is_finite(body.position)) << soil.name;
    EXPECT_GT(body.max_sinkage, 0.02 * body.radius) << soil.name;
    EXPECT_LT(body.sinkage, 2 * body.radius) << soil.name;
  }
}

TEST(Toolbox, BallsAreWeighedForTheSoilBelowThem) {
  Scene scene;
  for (const char* name : {"asphalt", "mud"}) scene.materials.push_back(*find_preset(name));
  MeshTerrain ground;
  for (std::uint32_t i = 0; i < 30 * 30; ++i) {
    ground.vertices.push_back({i % 30 * 1.0, i / 30 * 1.0, 0});
    ground.materials.push_back(i % 30 < 15 ? 0 : 1);
    if (i % 30 == 29 || i / 30 == 29) continue;
    for (const std::uint32_t corner : {i, i + 1, i + 31, i, i + 31, i + 30}) ground.triangles.push_back(corner);
  }
  scene.terrain.shape = ground;
  World world = World::create(scene, std::make_shared<const Jobs>(1)).value();
  const Toolbox tools(world);
  ASSERT_TRUE(tools.drop(world, 5, 15));
  ASSERT_TRUE(tools.drop(world, 25, 15));
  EXPECT_GT(world.bodies()[0].mass, 10 * world.bodies()[1].mass) << "asphalt carries more than mud";
}

// A renderer that takes `full` seconds for all pixels, a quarter of it whatever their number.
double share_after(PixelShare& pixels, double full, double seconds) {
  for (double time = 0; time < seconds;) {
    const double picture = full * (0.25 + 0.75 * pixels.share() * pixels.share());
    pixels.see(picture);
    time += picture;
  }
  return pixels.share();
}

TEST(PixelShare, FollowsWhatIsAffordable) {
  PixelShare pixels(1.0 / 60);
  EXPECT_EQ(share_after(pixels, 0.016, 10), 1);
  const double slow = share_after(pixels, 0.025, 10);
  EXPECT_LT(slow, 1);
  EXPECT_GT(slow, 0.5);
  EXPECT_EQ(share_after(pixels, 0.2, 10), 0.5);
  EXPECT_EQ(share_after(pixels, 0.2, 10), 0.5) << "no less than half";
  EXPECT_LT(share_after(pixels, 0.008, 1), 1) << "step by step, so that sharpness does not flicker";
  EXPECT_EQ(share_after(pixels, 0.008, 10), 1);
}

TEST(PixelShare, OneLongPictureIsNoReason) {
  PixelShare pixels(1.0 / 60);
  for (int i = 0; i < 300; ++i) {
    pixels.see(i % 100 == 50 ? 2 : 0.012);
    EXPECT_EQ(pixels.share(), 1) << i;
  }
}

TEST(PixelShare, GoesBackWhereFewerPixelsGainNothing) {
  PixelShare pixels(1.0 / 60);
  double all = 0, sharp = 0;
  while (all < 60) {
    const double share = pixels.share(), picture = share < 1 ? 0.041 : 0.040;
    pixels.see(picture);
    all += picture;
    sharp += share == 1 ? picture : 0;
  }
  EXPECT_GT(sharp, 0.9 * all);
  EXPECT_LT(sharp, all) << "it was tried";
}

TEST(PixelShare, StaysWhereItFits) {
  PixelShare pixels(1.0 / 60);
  share_after(pixels, 0.022, 2);
  const double share = pixels.share();
  EXPECT_LT(share, 1);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(share_after(pixels, 0.022, 1), share) << i;
}

TEST(CameraControl, KeepsWhatItShould) {
  const Camera start{.eye = {100, -200, 120}, .target = {10, 20, 5}};
  CameraControl control(start);
  EXPECT_LT(length(control.camera().eye - start.eye), 1e-9);
  control.orbit(0.3, 0.1);
  EXPECT_NEAR(length(control.camera().eye - control.camera().target), length(start.eye - start.target), 1e-9);
  EXPECT_LT(length(control.camera().target - start.target), 1e-9);
  const double before = control.distance();
  control.zoom(3);
  control.zoom(-3);
  EXPECT_NEAR(control.distance(), before, 1e-9);
  const Vec3d view = control.camera().eye - control.camera().target;
  control.pan(0.2, -0.1);
  EXPECT_LT(length(control.camera().eye - control.camera().target - view), 1e-9);
  control.keep_above(1000, 5);
  EXPECT_NEAR(control.camera().eye.z, 1005, 1e-9);
  control.keep_above(std::nan(""), 5);
  EXPECT_NEAR(control.camera().eye.z, 1005, 1e-9);
}

TEST(ColorScale, RangesAreRound) {
  const ColorScale sinkage = color_scale(ColorBy::sinkage, {.largest_sinkage = 23.8f});
  EXPECT_FLOAT_EQ(sinkage.high, 50);
  EXPECT_FLOAT_EQ(sinkage.low, -50);
  EXPECT_FLOAT_EQ(color_scale(ColorBy::sinkage, {.largest_sinkage = 0.02f}).high, 0.02f);
  EXPECT_TRUE(color_scale(ColorBy::natural, {}).title.empty());
  const ColorScale height = color_scale(ColorBy::height, {.lowest = 100, .highest = 300});
  EXPECT_FLOAT_EQ(height.low, 100);
  EXPECT_FLOAT_EQ(height.high, 300);
}

TEST(StageMeter, ShowsWhatAPictureTook) {
  StageMeter meter;
  std::vector<StageTime> totals = {{.name = "forces", .ms = 0}};
  for (int i = 1; i < 300; ++i) {
    totals[0].ms = 2.0 * i;
    meter.update(totals);
  }
  EXPECT_NEAR(meter.rows()[0].ms, 2, 0.01);
  // A new world counts from 0.
  totals[0].ms = 0;
  meter.update(totals);
  EXPECT_NEAR(meter.rows()[0].ms, 2, 0.01);
}

}  // namespace
}  // namespace divot::viewer
