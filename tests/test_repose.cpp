// Loose soil at rest is nowhere steeper than its angle of repose by more than two degrees, but where a body holds it;
// and when the body leaves, what it held slides too.
#include <algorithm>
#include <array>

#include "support.h"

namespace divot {
namespace {

using test::degrees;

constexpr std::array<const char*, 4> kLoose = {"dry_sand", "lete_sand", "gravel", "lunar_regolith"};
constexpr double kSpacing = 0.05, kAllowed_deg = 2;

// The steepest triangle with a corner further than `reach` from the body, degrees.
double steepest_deg(const World& world, double reach) {
  const SurfaceView ground = world.surface();
  const BodyView body = world.bodies().front();
  const auto away = [&](std::uint32_t vertex) {
    const Vec3d p = to_double(ground.positions[vertex]) - (body.position - ground.origin);
    const auto* ball = std::get_if<Sphere>(body.shape.get());
    if (ball) return std::sqrt(dot(p, p)) - ball->radius;
    const auto& wheel = std::get<Cylinder>(*body.shape);  // along y
    return std::max(std::hypot(p.x, p.z) - wheel.radius, std::abs(p.y) - wheel.length / 2);
  };
  double most = 0;
  for (std::size_t k = 0; k + 2 < ground.triangles.size(); k += 3) {
    const std::uint32_t* v = &ground.triangles[k];
    if (std::max({away(v[0]), away(v[1]), away(v[2])}) <= reach) continue;
    const Vec3 a = ground.positions[v[0]], n = cross(ground.positions[v[1]] - a, ground.positions[v[2]] - a);
    most = std::max<double>(most, degrees(std::atan2(std::hypot(n.x, n.y), n.z)));
  }
  return most;
}

// Stands for `seconds` and is then lifted off.
void check_beside(const char* soil, const Shape& shape, double mass, double drop) {
  Scene scene;
  scene.terrain = {.shape = GridTerrain{.columns = 61, .rows = 61, .spacing = kSpacing}, .material = soil};
  scene.bodies = {
      {.name = "body", .shape = shape, .mass = mass, .position = {0.01, 0.013, drop}, .above_ground = true}};
  World world = test::make_world(scene);
  test::run_to(world, 5);
  const double allowed = find_preset(soil)->repose_angle_deg + kAllowed_deg;
  EXPECT_LE(steepest_deg(world, 2 * kSpacing), allowed) << soil << ": the soil touches the body there";
  const std::vector<Vec3> before(world.surface().positions.begin(), world.surface().positions.end());
  test::run_to(world, 6);
  float crept = 0;
  for (std::size_t v = 0; v < before.size(); ++v)
    crept = std::max(crept, std::abs(world.surface().positions[v].z - before[v].z));
  EXPECT_LE(crept, 1e-4) << soil << ": at rest";

  ASSERT_TRUE(world.add_joint({.type = JointType::slider, .second = "body", .motor_speed = 2, .motor_force = 1e6}));
  test::run_to(world, 9);
  EXPECT_GT(world.bodies().front().position.z, 4) << "it is gone";
  EXPECT_LE(steepest_deg(world, 0), allowed) << soil << ": after it left";
  EXPECT_EQ(test::awake(world), 0);
}

TEST(Repose, SoilBesideABallThatFellLeansOnItAndSlidesWhenItLeaves) {
  for (const char* soil : kLoose) check_beside(soil, Sphere{.radius = 0.5}, 3000, 2);
}

TEST(Repose, SoilBesideAWheelThatStandsLeansOnItAndSlidesWhenItLeaves) {
  for (const char* soil : kLoose) check_beside(soil, Cylinder{.radius = 0.4, .length = 0.3}, 540, 0);
}

}  // namespace
}  // namespace divot
