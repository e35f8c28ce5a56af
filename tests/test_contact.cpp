// Bodies and ground: sinkage, bounce, rolling, friction, and who is found under a ball.
#include <algorithm>

#include "contact/contact.h"
#include "contact/near.h"
#include "support.h"

namespace divot::contact {
namespace {

using test::make_world;
using test::run_to;

constexpr double kGravity = 9.81;

// A ball that just touches flat ground, at rest.
Scene ball_scene(const std::string& material, double spacing, double radius, double mass, int size = 61) {
  Scene scene;
  scene.terrain = {.shape = GridTerrain{.columns = size, .rows = size, .spacing = spacing}, .material = material};
  scene.bodies = {{.name = "ball", .shape = Sphere{radius}, .mass = mass, .position = {0, 0, 0}, .above_ground = true}};
  return scene;
}

// ---- sinkage

Material soft_soil() {
  Material soil = *find_preset("dry_sand");
  soil.name = "soft";
  soil.bekker_kc = 0, soil.bekker_kphi = 0.2e6, soil.bekker_n = 1.1;
  return soil;
}

Scene sinking_scene(double mass, double dt) {
  Scene scene = ball_scene("soft", 0.05, 1, mass);
  scene.materials = {soft_soil()};
  scene.dt = dt;
  return scene;
}

// Depth at which Bekker's pressure, integrated over the ball's underside, carries it.
double static_sinkage(double mass, double radius, double k, double n) {
  double low = 0, high = radius;
  for (int i = 0; i < 60; ++i) {
    const double z = 0.5 * (low + high);
    const double load =
        2 * std::numbers::pi * k * ((radius - z) * std::pow(z, n + 1) / (n + 1) + std::pow(z, n + 2) / (n + 2));
    (load < mass * kGravity ? low : high) = z;
  }
  return low;
}

void expect_static_sinkage(double dt, double until) {
  World world = make_world(sinking_scene(2000, dt));
  const double expected = static_sinkage(2000, 1, 0.2e6, 1.1);
  run_to(world, 2);  // its weight comes in one and a half seconds
  EXPECT_NEAR(world.bodies()[0].sinkage, expected, 0.1 * expected);
  run_to(world, until);
  EXPECT_NEAR(world.bodies()[0].sinkage, expected, 0.1 * expected) << "it creeps";
  EXPECT_NEAR(world.bodies()[0].position.z, 1 - expected, 0.1 * expected);
  EXPECT_LT(length(world.bodies()[0].velocity), 1e-3);
}

TEST(ContactSinkage, OfABallSetDownGentlyIsBekkersAtSixtyHertz) { expect_static_sinkage(1.0 / 60, 5); }
TEST(ContactSinkage, OfABallSetDownGentlyIsBekkersInShortSteps) { expect_static_sinkage(0.002, 5); }

// A ball ten times as heavy as the soil it displaces would overshoot by half if all its weight came at once.
TEST(ContactSinkage, OfAHeavyBallSetDownGentlyIsBekkersToo) {
  World world = make_world(ball_scene("dry_sand", 0.1, 1, 20000, 41));
  const Material sand = *find_preset("dry_sand");
  const double expected = static_sinkage(20000, 1, sand.bekker_kphi, sand.bekker_n);
  run_to(world, 3);
  EXPECT_NEAR(world.bodies()[0].max_sinkage, expected, 0.1 * expected);
}

TEST(ContactSinkage, GrowsWithMass) {
  double before = 0;
  for (const double mass : {250.0, 1000.0, 4000.0}) {
    World world = make_world(sinking_scene(mass, 1.0 / 60));
    run_to(world, 1);
    EXPECT_GT(world.bodies()[0].sinkage, 1.2 * before) << mass;
    before = world.bodies()[0].sinkage;
  }
}

TEST(ContactSinkage, GrowsWithTheDrop) {
  double before = 0;
  for (const double height : {0.0, 0.5, 2.0, 8.0}) {
    Scene scene = ball_scene("dry_sand", 0.1, 0.3, 250, 31);
    scene.bodies[0].position.z = height;
    World world = make_world(scene);
    run_to(world, 2);
    EXPECT_GT(world.bodies()[0].max_sinkage, 1.15 * before) << height;
    before = world.bodies()[0].max_sinkage;
  }
}

TEST(ContactSinkage, OfADroppedBodyIsTheSameInStepsOfAnyLength) {
  const std::pair<const char*, Shape> falls[] = {{"dry_sand", Sphere{0.3}},
                                                 {"mud", Sphere{0.3}},
                                                 {"sandy_loam", Box{{0.5, 0.6, 0.4}}},
                                                 {"snow", Capsule{0.2, 0.5}}};
  for (const auto& [soil, shape] : falls) {
    double deepest[2];
    for (const int fine : {0, 1}) {
      Scene scene = ball_scene(soil, 0.05, 0.3, 250, 41);
      scene.bodies[0].shape = shape, scene.bodies[0].position.z = 2, scene.dt = fine ? 1.0 / 960 : 1.0 / 60;
      World world = make_world(scene);
      run_to(world, 1.2);
      deepest[fine] = world.bodies()[0].max_sinkage;
    }
    EXPECT_NEAR(deepest[0], deepest[1], 0.05 * deepest[1]) << soil;
  }
}

// A particle's layer, and its bonds, would carry a small light ball like a net.
TEST(ContactSinkage, OfADroppedBallGoesWithItsSize) {
  const auto depth_over_diameter = [](double radius) {
    Scene scene = ball_scene("dry_sand", radius / 5, radius, 2000 * 4.19 * radius * radius * radius, 41);
    scene.bodies[0].position.z = 20 * radius, scene.dt = 1.0 / 240;
    World world = make_world(scene);
    run_to(world, std::sqrt(40 * radius / 9.81) + 0.3);
    return world.bodies()[0].max_sinkage / radius;
  };
  EXPECT_NEAR(depth_over_diameter(0.02) / depth_over_diameter(0.32), 1, 0.15);
}

TEST(ContactSinkage, MudYieldsAndAsphaltBarely) {
  World mud = make_world(ball_scene("mud", 0.1, 0.5, 1500)),
        asphalt = make_world(ball_scene("asphalt", 0.1, 0.5, 1500));
  run_to(mud, 2), run_to(asphalt, 2);
  EXPECT_GT(mud.bodies()[0].max_sinkage, 0.05);
  EXPECT_LT(asphalt.bodies()[0].max_sinkage, 1e-3);
}

TEST(ContactSinkage, AFeatherRestsOnAsphalt) {
  World world = make_world(ball_scene("asphalt", 0.1, 0.1, 0.01));
  run_to(world, 2);
  EXPECT_NEAR(world.bodies()[0].position.z, 0.1, 1e-3);
  EXPECT_LT(length(world.bodies()[0].velocity), 1e-3);
}

// ---- bounce

// Square root of the height it comes back to over the height it fell from: what is left of its speed.
double bounce(const std::string& material, double spacing, double mass) {
  Scene scene = ball_scene(material, spacing, 0.5, mass, 41);
  scene.bodies[0].position.z = 2;
  World world = make_world(scene);
  run_to(world, 0.7);  // it has met the ground at 0.64 s
  double highest = 0;
  while (world.time() < 1.4) {
    world.step();
    highest = std::max(highest, world.bodies()[0].position.z - 0.5);
  }
  return std::sqrt(highest / 2);
}

TEST(ContactBounce, OnAsphaltIsTheProductOfBoth) {
  const double expected = 0.5 * find_preset("asphalt")->restitution;
  for (const auto& [spacing, mass] :
       {std::pair{0.25, 50.0}, {0.25, 500.0}, {0.1, 500.0}, {0.1, 1300.0}, {0.05, 1300.0}})
    EXPECT_NEAR(bounce("asphalt", spacing, mass), expected, 0.15 * expected) << spacing << ' ' << mass;
}

TEST(ContactBounce, IsNoneToSpeakOfOnMud) { EXPECT_LT(bounce("mud", 0.1, 500), 0.1); }

TEST(ContactBounce, ADeadBallStays) {
  Scene scene = ball_scene("asphalt", 0.25, 0.5, 500, 41);
  scene.bodies[0].position.z = 2, scene.bodies[0].restitution = 0;
  World world = make_world(scene);
  run_to(world, 0.8);
  EXPECT_NEAR(world.bodies()[0].position.z, 0.5, 0.01);
  EXPECT_LT(std::abs(world.bodies()[0].velocity.z), 0.05);
}

// ---- rolling and sliding

double energy(const BodyView& b) {
  const double inertia = 0.4 * b.mass * b.radius * b.radius;
  return 0.5 * b.mass * dot(b.velocity, b.velocity) + 0.5 * inertia * dot(b.angular_velocity, b.angular_velocity) +
         b.mass * kGravity * b.position.z;
}

TEST(ContactRolling, EnergyNeverRisesOnAsphalt) {
  for (const double spacing : {0.25, 0.1})
    for (const bool rolls : {false, true}) {
      Scene scene = ball_scene("asphalt", spacing, 0.5, 1300, static_cast<int>(20 / spacing));
      scene.bodies[0].position.x = -8, scene.bodies[0].velocity = {7, 0.8, 0};
      if (rolls) scene.bodies[0].angular_velocity = {-1.6, 14, 0};
      World world = make_world(scene);
      double least = energy(world.bodies()[0]);
      const double moving = least - 1300 * kGravity * 0.5;
      for (int step = 0; step < 120; ++step) {
        world.step();
        const double now = energy(world.bodies()[0]);
        ASSERT_LT(now, least + 0.005 * moving) << spacing << ' ' << rolls << " step " << step;
        least = std::min(least, now);
      }
    }
}

// Sliding ends where the ball rolls: 5/7 of the speed is left, whatever the friction.
TEST(ContactRolling, ASlidingBallComesToRollAtFiveSeventhsOfItsSpeed) {
  Scene scene = ball_scene("asphalt", 0.25, 0.5, 1300, 81);
  scene.bodies[0].position.x = -8, scene.bodies[0].velocity = {7, 0, 0};
  World world = make_world(scene);
  run_to(world, 1.5);
  const BodyView ball = world.bodies()[0];
  EXPECT_NEAR(ball.velocity.x, 5, 0.25);
  EXPECT_NEAR(ball.angular_velocity.y * ball.radius, ball.velocity.x, 0.1);
  EXPECT_NEAR(ball.velocity.y, 0, 0.05);
}

TEST(ContactRolling, ARollingBallRollsOnOverAsphalt) {
  Scene scene = ball_scene("asphalt", 0.25, 0.5, 1300, 101);
  scene.bodies[0].position.x = -10, scene.bodies[0].velocity = {5, 0, 0}, scene.bodies[0].angular_velocity = {0, 10, 0};
  World world = make_world(scene);
  run_to(world, 3);
  EXPECT_NEAR(world.bodies()[0].velocity.x, 5, 0.5);
  EXPECT_LT(world.bodies()[0].max_sinkage, 1e-3);
}

TEST(ContactRolling, DownASlopeAtFiveSeventhsOfGravity) {
  const double slope = test::radians(15), expected = 5.0 / 7 * kGravity * std::sin(slope);
  for (const double spacing : {0.25, 0.1}) {
    Scene scene = ball_scene("asphalt", spacing, 0.5, 1300, static_cast<int>(14 / spacing) + 1);
    std::get<GridTerrain>(scene.terrain.shape).height = [&](double x, double) { return -std::tan(slope) * x; };
    scene.bodies[0].position = {-5, 0.03, 0};
    World world = make_world(scene);
    run_to(world, 1);  // it is set down
    const Vec3d early = world.bodies()[0].velocity;
    run_to(world, 2.5);
    const BodyView ball = world.bodies()[0];
    EXPECT_NEAR((length(ball.velocity) - length(early)) / 1.5, expected, 0.1 * expected) << spacing;
    EXPECT_NEAR(ball.angular_velocity.y * ball.radius, length(ball.velocity), 0.05 * length(ball.velocity)) << spacing;
    EXPECT_NEAR(ball.position.y, 0.03, 0.01);
  }
}

TEST(ContactRolling, SoftGroundStopsWhatHardGroundDoesNot) {
  const auto speed_after = [](const char* material) {
    Scene scene = ball_scene(material, 0.25, 0.5, 600, 81);
    scene.bodies[0].position.x = -8, scene.bodies[0].velocity = {5, 0, 0},
    scene.bodies[0].angular_velocity = {0, 10, 0};
    World world = make_world(scene);
    run_to(world, 1.5);
    return world.bodies()[0].velocity.x;
  };
  EXPECT_LT(speed_after("mud"), 0.5 * speed_after("asphalt"));
}

// The patch is two cells wide on the coarse grid: its columns still resist as they do on a fine one.
TEST(ContactRolling, HowFarABallRollsDependsLittleOnTheGrid) {
  const auto way = [](double spacing) {
    Scene scene = ball_scene("dry_sand", spacing, 0.6, 600, static_cast<int>(12 / spacing) + 1);
    scene.bodies[0].position.x = -5, scene.bodies[0].velocity = {3, 0, 0}, scene.bodies[0].angular_velocity = {0, 5, 0};
    World world = make_world(scene);
    run_to(world, 2);
    return world.bodies()[0].position.x + 5;
  };
  const double fine = way(0.1);
  EXPECT_GT(fine, 3);
  EXPECT_NEAR(way(0.2), fine, 0.04 * fine);
}

// ---- odd places

TEST(Contact, ABallBornInTheGroundIsNotThrownOut) {
  for (const char* material : {"asphalt", "dry_sand", "mud"})
    for (const double depth : {0.05, 0.1, 0.3}) {
      Scene scene = ball_scene(material, 0.1, 0.5, 1300, 41);
      scene.bodies[0].above_ground = false, scene.bodies[0].position = {0, 0, 0.5 - depth};
      World world = make_world(scene);
      double highest = -1, fastest = 0;
      for (int step = 0; step < 60; ++step) {
        world.step();
        highest = std::max(highest, world.bodies()[0].position.z);
        fastest = std::max(fastest, length(world.bodies()[0].velocity));
      }
      EXPECT_LT(highest, 0.5 - depth + 0.01) << material << ' ' << depth;
      EXPECT_LT(fastest, 1) << material << ' ' << depth;
      EXPECT_TRUE(test::all_finite(world));
    }
}

TEST(Contact, ABallWhoseCentreIsInTheGroundIsRefused) {
  Scene scene = ball_scene("dry_sand", 0.25, 0.5, 500, 21);
  scene.bodies[0].above_ground = false, scene.bodies[0].position = {0, 0, -0.25};
  const auto world = World::create(scene);
  ASSERT_FALSE(world);
  EXPECT_NE(world.error().front().text().find("0.25 m below the ground"), std::string::npos)
      << world.error().front().text();
  scene.bodies[0].position.x = 100;  // beside the terrain there is nothing it could be in
  EXPECT_TRUE(World::create(scene));
}

TEST(Contact, OverTheEdgeItFalls) {
  Scene scene = ball_scene("asphalt", 0.25, 0.5, 500, 41);
  scene.bodies[0].position.x = 2, scene.bodies[0].velocity = {6, 0, 0};
  World world = make_world(scene);
  run_to(world, 3);
  const BodyView ball = world.bodies()[0];
  EXPECT_TRUE(ball.off_terrain);
  EXPECT_FALSE(ball.touching);
  EXPECT_LT(ball.position.z, -5);
  EXPECT_GT(ball.position.x, 5);
  EXPECT_TRUE(test::all_finite(world));
  // Nothing but gravity from here on.
  const double before = ball.velocity.z;
  run_to(world, 3.5);
  EXPECT_NEAR(world.bodies()[0].velocity.z - before, -0.5 * kGravity, 1e-6);
}

TEST(Contact, InTheAirItFliesAsItShould) {
  Scene scene = ball_scene("dry_sand", 0.5, 0.5, 500, 41);
  scene.bodies[0].position.z = 30, scene.bodies[0].velocity = {3, 0, 5};
  scene.dt = 0.001;
  World world = make_world(scene);
  run_to(world, 1);
  EXPECT_NEAR(world.bodies()[0].position.z, 30.5 + 5 - kGravity / 2, 0.01);
  EXPECT_NEAR(world.bodies()[0].position.x, 3, 1e-6);
  EXPECT_EQ(world.bodies()[0].sinkage, 0);
  EXPECT_EQ(world.peak_particles(), 0u);
}

TEST(Contact, BallsThatCollideKeepTheirMomentum) {
  Scene scene;
  scene.gravity = {};
  scene.bodies = {{.name = "a", .shape = Sphere{1}, .mass = 2, .position = {-3, 0, 20}, .velocity = {5, 0, 0}},
                  {.name = "b", .shape = Sphere{1}, .mass = 6, .position = {0, 0.3, 20}}};
  World world = make_world(scene);
  run_to(world, 2);
  const auto bodies = world.bodies();
  EXPECT_GT(bodies[1].velocity.x, 0.5);
  EXPECT_LT(length(2.0 * bodies[0].velocity + 6.0 * bodies[1].velocity - Vec3d{10, 0, 0}), 1e-6);
}

// Touching each other, in ground that both have pressed.
TEST(Contact, TwoHeavyBallsSideBySideSinkAlike) {
  Scene scene = ball_scene("mud", 0.1, 0.5, 1200, 51);
  scene.bodies[0].position.x = -0.51;
  scene.bodies.push_back(scene.bodies[0]);
  scene.bodies[1].name = "other", scene.bodies[1].position.x = 0.51;
  World world = make_world(scene);
  for (int step = 0; step < 120; ++step) {
    world.step();
    ASSERT_TRUE(test::all_finite(world));
    ASSERT_LT(length(world.bodies()[0].velocity), 10);
  }
  const auto bodies = world.bodies();
  EXPECT_GT(bodies[0].sinkage, 0.1);
  EXPECT_NEAR(bodies[0].sinkage, bodies[1].sinkage, 0.05 * bodies[0].sinkage);
  EXPECT_LT(world.soil_volume().relative_error(), 0.01);
}

// ---- stages' own

TEST(ContactCarry, TheDeeperOfTwoBodiesCarriesAVertex) {
  for (const bool deeper_first : {true, false}) {
    test::Sheet s = test::make_sheet({.columns = 5, .rows = 5, .spacing = 1});
    std::vector<state::Body> bodies(2);
    Scratch scratch;
    scratch.bodies.resize(2);
    const Vec3 place = s.surface.position[12];
    for (int k = 0; k < 2; ++k) {
      const float depth = (k == 0) == deeper_first ? 0.3f : 0.1f;
      scratch.bodies[static_cast<std::size_t>(k)].presses.push_back(
          {.vertex = 12, .position = place - Vec3{0, 0, depth}, .plastic = depth});
    }
    carry(bodies, s.particles, s.soil, s.surface, 0.1, scratch);
    EXPECT_EQ(s.particles.hold[12], Hold::carried);
    EXPECT_NEAR(s.particles.vz[12], -3, 1e-5);
    EXPECT_FLOAT_EQ(s.soil.plastic[s.particles.column[12]], 0.3f);
    EXPECT_EQ(s.particles.hold[11], Hold::free);
  }
}

TEST(ContactCarry, WhatIsNoLongerPressedIsFreeAtRest) {
  test::Sheet s = test::make_sheet({.columns = 5, .rows = 5, .spacing = 1});
  std::vector<state::Body> bodies(1);
  Scratch scratch;
  scratch.bodies.resize(1);
  scratch.bodies[0].last.push_back({.vertex = 12});
  s.particles.hold[12] = Hold::carried;
  s.particles.vz[12] = -1;
  s.soil.shear[s.particles.column[12]] = {0.1f, 0, 0};
  carry(bodies, s.particles, s.soil, s.surface, 0.1, scratch);
  EXPECT_EQ(s.particles.hold[12], Hold::free);
  EXPECT_EQ(s.particles.velocity(12), Vec3{});
  EXPECT_EQ(s.soil.shear[s.particles.column[12]], Vec3{});
}

void set_ball(state::Body& body, double radius) {
  body.solid = std::make_shared<const geometry::Solid>(*geometry::make_solid(Sphere{radius}));
  body.radius = radius;
}

// Whoever walks over the half-edges finds whom the hierarchy finds, and that is everyone.
TEST(ContactNear, WalkFindsWhatTheBvhFinds) {
  const state::Surface surface =
      test::make_surface({.columns = 81, .rows = 81, .spacing = 0.25, .height = [](double x, double y) {
                            return 0.5 * std::sin(1.3 * x) * std::cos(1.1 * y) + 0.1 * std::sin(5 * x + 3 * y);
                          }});
  geometry::Bvh bvh;
  bvh.build(surface.mesh.face_count(), geometry::corners_in(surface.mesh.triangles()), surface.position, 0.02f,
            geometry::Bvh::Order::as_numbered, Jobs(1));
  const state::Soil soil;
  const state::Particles particles;
  const std::vector<laws::Medium> media = {laws::make_medium(Material{})};
  const Situation s{surface, bvh, soil, particles, media, {0, 0, -kGravity}, 1.0 / 60, 0, {}};

  test::Random random(31);
  state::Body walker;
  walker.spacing = surface.spacing;
  walker.position = {random.in(-6.0, 6.0), random.in(-6.0, 6.0), 0};
  Scratch::PerBody scratch;
  std::size_t found = 0;
  for (int step = 0; step < 300; ++step) {
    set_ball(walker, random.in(0.2, 1.5));
    walker.velocity = {random.in(-6.0, 6.0), random.in(-6.0, 6.0), random.in(-1.0, 1.0)};
    walker.position += (3 * s.dt) * walker.velocity;
    // It stays on the terrain and near the ground; at the border it takes the hierarchy anyhow.
    walker.position.x = std::clamp(walker.position.x, -9.9, 9.9),
    walker.position.y = std::clamp(walker.position.y, -9.9, 9.9);
    walker.position.z = random.in(-0.5, 0.5) + walker.radius;
    scratch.start.place(*walker.solid, walker.position, {});
    walker.near_left = -1;
    state::Body asker = walker;
    asker.last_vertex = kNone;
    find_near(walker, s, scratch);
    find_near(asker, s, scratch);
    ASSERT_EQ(walker.near, asker.near) << "step " << step;
    std::vector<std::uint32_t> all;
    for (std::uint32_t v = 0; v < surface.position.size(); ++v)
      if (scratch.start.within_reach(surface.position[v], walker.near_left)) all.push_back(v);
    ASSERT_EQ(walker.near, all) << "step " << step;
    found += all.size();
    if (!walker.near.empty()) walker.last_vertex = walker.near[random.below(walker.near.size())];
  }
  EXPECT_GT(found, 3000u);
}

TEST(ContactNear, WhatWasFoundServesUntilItCannot) {
  const state::Surface surface = test::make_surface({.columns = 41, .rows = 41, .spacing = 0.25});
  geometry::Bvh bvh;
  bvh.build(surface.mesh.face_count(), geometry::corners_in(surface.mesh.triangles()), surface.position, 0.02f,
            geometry::Bvh::Order::as_numbered, Jobs(1));
  const state::Soil soil;
  const state::Particles particles;
  const std::vector<laws::Medium> media = {laws::make_medium(Material{})};
  const Situation s{surface, bvh, soil, particles, media, {0, 0, -kGravity}, 1.0 / 60, 0, {}};
  state::Body body;
  body.spacing = surface.spacing;
  set_ball(body, 0.5), body.position = {0.1, 0.2, 0.45}, body.velocity = {0.2, 0, 0};
  Scratch::PerBody scratch;
  scratch.start.place(*body.solid, body.position, {});
  find_near(body, s, scratch);
  EXPECT_GT(body.near_left, 0);
  const std::vector<std::uint32_t> kept = body.near;
  body.near.pop_back();  // still there after the next call: nothing was looked for
  find_near(body, s, scratch);
  EXPECT_EQ(body.near.size() + 1, kept.size());
  body.near_left = -1;
  find_near(body, s, scratch);
  EXPECT_EQ(body.near, kept);
}

}  // namespace
}  // namespace divot::contact
