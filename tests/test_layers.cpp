#include <gtest/gtest.h>

#include <cmath>

#include "laws/blast.h"
#include "laws/crust.h"
#include "support.h"

namespace divot::test {
namespace {

// A road of 0.1 m over wet clay.
Scene road_scene(double spacing, int count) {
  Scene scene;
  Material road = *find_preset("asphalt");
  road.name = "road", road.over = "clay_wet", road.over_thickness = 0.1;
  scene.materials = {road};
  scene.terrain = {.shape = GridTerrain{.columns = count, .rows = count, .spacing = spacing}, .material = "road"};
  return scene;
}

Scene with_ball(double mass) {
  Scene scene = road_scene(0.1, 31);
  scene.bodies = {{.name = "ball", .shape = Sphere{0.5}, .mass = mass, .position = {}, .above_ground = true}};
  return scene;
}

std::size_t broken(const World& world) {
  std::size_t count = 0;
  for (const std::uint8_t material : world.surface().materials) count += material != 0;
  return count;
}

Crater crater_of(Scene scene, double yield) {
  scene.bombs = {{.time = 0, .position = {}, .above_ground = true, .yield = yield}};
  World world = make_world(scene);
  run_to(world, 1.5);
  return world.craters().front();
}

TEST(Layers, WorldsKnowWhatLiesBelow) {
  const World world = make_world(road_scene(1, 5));
  ASSERT_EQ(world.materials().size(), 2u);
  EXPECT_EQ(world.materials()[0].name, "road");
  EXPECT_EQ(world.materials()[1].name, "clay_wet");
  EXPECT_EQ(broken(world), 0u);
}

TEST(Layers, ACrustCarriesWhatItsRimHolds) {
  const laws::Medium crust{.cohesion = 1e6f, .thickness = 0.1f};
  EXPECT_NEAR(laws::punching_pressure(crust, 0.2), 1e6, 1);  // 2 t c / b
  World light = make_world(with_ball(1000)), heavy = make_world(with_ball(20000));
  run_to(light, 1), run_to(heavy, 1);
  EXPECT_EQ(broken(light), 0u);
  EXPECT_LT(light.bodies()[0].max_sinkage, 1e-3);
  EXPECT_GT(broken(heavy), 0u);
  EXPECT_GT(heavy.bodies()[0].max_sinkage, 0.1);
}

// Broken ground answers as the softer ground does: through a millimetre of asphalt a ball of 5 t sinks as deep as
// Bekker's law has it in wet clay. On 0.1 m it would hang in the hole that it punched, by a rim that holds more the
// wider it gets.
TEST(Layers, BrokenGroundIsTheSofterGround) {
  Scene thin = with_ball(5000);
  thin.materials[0].over_thickness = 0.001;
  World world = make_world(thin);
  run_to(world, 2);
  const double z = world.bodies()[0].sinkage, radius = 0.5, b = std::sqrt(z * (2 * radius - z));
  const Material& clay = *find_preset("clay_wet");
  const double n = clay.bekker_n, k = clay.bekker_kc / b + clay.bekker_kphi;
  const double carried =
      2 * std::numbers::pi * k * ((radius - z) * std::pow(z, n + 1) / (n + 1) + std::pow(z, n + 2) / (n + 2));
  EXPECT_GT(z, 0.1);
  EXPECT_NEAR(carried, 5000 * 9.81, 0.1 * 5000 * 9.81);
}

TEST(Layers, ASmallBombScarsAndALargeOneBreaks) {
  // 1 kg: half as deep as the crust is thick.
  Scene small = road_scene(0.04, 61);
  const Crater scar = crater_of(small, 0.0005);
  EXPECT_LT(scar.depth, 0.1);
  EXPECT_GT(scar.depth, 0.02);

  // 1 t: the crater that wet clay alone would have, a little narrower.
  Scene large = road_scene(0.4, 81), bare = large;
  bare.terrain.material = "clay_wet";
  const Crater in_road = crater_of(large, 1), in_clay = crater_of(bare, 1);
  EXPECT_NEAR(in_road.depth, in_clay.depth, 0.15 * in_clay.depth);
  EXPECT_LT(in_road.width, in_clay.width);
  EXPECT_GT(in_road.width, 0.8 * in_clay.width);
}

TEST(Layers, TheBrokenRadiusGrowsFromTheCrustsToTheSoils) {
  Material road = *find_preset("asphalt");
  road.over = "clay_wet", road.over_thickness = 0.1;
  const laws::Medium crust = laws::make_medium(road), clay = laws::make_medium(*find_preset("clay_wet"));
  const auto scaled = [&](double kg) { return laws::broken_radius(crust, clay, kg / 1000, 0, 0) / std::cbrt(kg); };
  EXPECT_EQ(scaled(1), 0);  // a crater of 0.079 m
  EXPECT_NEAR(scaled(2.1), 0.1 * laws::surface_radius(1, crust.blast_strength), 0.02);
  EXPECT_GT(scaled(100), scaled(10));
  EXPECT_NEAR(scaled(1e7), 0.1 * laws::surface_radius(1, clay.blast_strength), 0.01);
  EXPECT_EQ(laws::broken_radius(crust, clay, 0.1, 20, 0), 0);  // far above the ground
}

TEST(Layers, ErrorsNameTheLayer) {
  const auto error_of = [](const std::string& materials) {
    const auto scene = parse_scene(
        "[terrain]\ngrid = { columns = 3, rows = 3, spacing = 1 }\nmaterial = \"a\"\n" + materials, "s.toml");
    return scene ? std::string() : scene.error().front().text();
  };
  EXPECT_EQ(error_of("[materials.a]\nover = { material = \"mud\", thickness = 0.1 }"), "");
  EXPECT_EQ(error_of("[materials.a]\nover = { material = \"mud\", thickness = 0 }"),
            "s.toml:5: materials.a.over.thickness: 0 is out of range; expected a number > 0 and <= 100000 (m)");
  EXPECT_EQ(error_of("[materials.a]\nover = { material = \"mud\" }"),
            "s.toml:5: materials.a.over.thickness: is missing; expected a number > 0 and <= 100000 (m)");
  EXPECT_EQ(error_of("[materials.a]\nover = { material = \"mudd\", thickness = 1 }").substr(0, 67),
            "s.toml:5: materials.a.over.material: there is no material \"mudd\"; e");
  EXPECT_EQ(error_of("[materials.a]\nover = { material = \"b\", thickness = 1 }\n"
                     "[materials.b]\nover = { material = \"a\", thickness = 1 }"),
            "s.toml:5: materials.a.over.material: the layers below a lead back to it or to each other; expected layers "
            "that end at a material without one below");
}

}  // namespace
}  // namespace divot::test
