// Soil is not lost: what the surface shows is missing is what the columns' books say was compacted or went elsewhere.
#include <algorithm>
#include <array>

#include "support.h"

namespace divot {
namespace {

using test::make_world;
using test::run_to;

void expect_balanced(const World& world, const std::string& where) {
  const SoilVolume soil = world.soil_volume();
  ASSERT_GT(soil.displaced, 0) << where;
  EXPECT_LT(soil.relative_error(), 0.01) << where << ": displaced " << soil.displaced << ", compacted "
                                         << soil.compacted << ", deposited " << soil.deposited;
}

// A rolling hill with a slope, so that nothing is level anywhere.
std::function<double(double, double)> hills(double slope, double size) {
  return [=](double x, double y) { return slope * x + 0.1 * size * std::sin(x / size) * std::cos(1.3 * y / size); };
}

TEST(SoilBalance, HoldsUnderBallsOfAnyMassOnSlopes) {
  test::Random random(11);
  constexpr std::array kSoils = {"dry_sand", "mud", "paper"};
  for (int k = 0; k < 9; ++k) {
    const double spacing = random.in(0.04, 0.2), radius = random.in(4.0, 10.0) * spacing;
    const char* material = kSoils[static_cast<std::size_t>(k) % 3];
    const double density = k % 3 == 2 ? random.in(0.01, 0.1) : random.in(500.0, 4000.0);
    Scene scene;
    scene.dt = random.in(0.003, 0.03);
    scene.terrain = {
        .shape =
            GridTerrain{
                .columns = 61, .rows = 51, .spacing = spacing, .height = hills(random.in(0.0, 0.4), 10 * spacing)},
        .material = material};
    for (int b = 0; b < 3; ++b)
      scene.bodies.push_back({.name = "ball " + std::to_string(b),
                              .shape = Sphere{radius},
                              .mass = density * 4.19 * radius * radius * radius,
                              .position = {random.in(-15.0, 15.0) * spacing, random.in(-15.0, 15.0) * spacing,
                                           random.in(0.0, 3.0) * radius},
                              .above_ground = true,
                              .velocity = {random.in(-3.0, 3.0), random.in(-3.0, 3.0), 0}});
    World world = make_world(scene);
    const std::string where = "case " + std::to_string(k) + ' ' + material;
    run_to(world, 0.4);
    if (world.soil_volume().displaced > 0) expect_balanced(world, where + " under way");
    run_to(world, 2);
    expect_balanced(world, where);
  }
}

TEST(SoilBalance, HoldsUnderBombsThatOverlapOnSlopes) {
  test::Random random(12);
  constexpr std::array kSoils = {"dry_sand", "mud", "paper"};
  for (int k = 0; k < 8; ++k) {
    const double yield = std::pow(10.0, random.in(-3.0, 3.0)), width = 7 * std::cbrt(yield);
    Scene scene;
    scene.dt = random.in(0.005, 0.03);
    scene.solver.blast = k == 2 || k == 5 ? Blast::paper : Blast::scaled;
    scene.terrain = {.shape = GridTerrain{.columns = 61,
                                          .rows = 61,
                                          .spacing = width / random.in(10.0, 20.0),
                                          .height = hills(random.in(0.0, 0.5), width)},
                     .material = kSoils[static_cast<std::size_t>(k) % 3]};
    for (int b = 0; b < 3; ++b)
      scene.bombs.push_back({.time = 0.3 * b,
                             .position = {random.in(-0.5, 0.5) * width, random.in(-0.5, 0.5) * width, 0},
                             .above_ground = true,
                             .yield = yield * random.in(0.3, 1.0)});
    World world = make_world(scene);
    const std::string where = "case " + std::to_string(k);
    run_to(world, 0.5);
    expect_balanced(world, where + " under way");
    run_to(world, 3);
    expect_balanced(world, where);
  }
}

TEST(SoilBalance, HoldsForTwoEqualCratersWithinEachOther) {
  Scene scene;
  scene.terrain.shape = GridTerrain{.columns = 37, .rows = 37, .spacing = 0.64};
  scene.bombs = {{.time = 0, .yield = 1}, {.time = 0.5, .position = {2, 0, 0}, .yield = 1}};
  World world = make_world(scene);
  run_to(world, 2);
  expect_balanced(world, "2 m apart");
}

// The border of the terrain stays where it is on the map, and the soil below it is accounted for like any other.
TEST(SoilBalance, HoldsAtTheBorder) {
  Scene scene;
  scene.terrain = {.shape = GridTerrain{.columns = 41, .rows = 41, .spacing = 0.1, .height = hills(0.3, 1)},
                   .material = "mud"};
  scene.bombs = {{.time = 0.1, .position = {1.9, 0.3, 0}, .above_ground = true, .yield = 0.001}};
  scene.bodies = {{.name = "ball",
                   .shape = Sphere{0.5},
                   .mass = 900,
                   .position = {-1.9, 0, 0},
                   .above_ground = true,
                   .velocity = {0, 1, 0}}};
  World world = make_world(scene);
  std::vector<Vec3> before(world.surface().positions.begin(), world.surface().positions.end());
  run_to(world, 2);
  expect_balanced(world, "at the border");
  for (std::size_t v = 0; v < before.size(); ++v) {
    if (std::abs(std::abs(before[v].x) - 2) > 0.01f && std::abs(std::abs(before[v].y) - 2) > 0.01f) continue;
    EXPECT_EQ(world.surface().positions[v].x, before[v].x);
    EXPECT_EQ(world.surface().positions[v].y, before[v].y);
  }
}

}  // namespace
}  // namespace divot
