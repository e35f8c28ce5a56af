#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "divot/world.h"
#include "viewer/renderer.h"
#include "viewer/test_pictures.h"

namespace divot::viewer {
namespace {

TEST(Render, BallIsWhereItShouldBe) {
  const TestSurface ground = paper_ground();
  const Shown shown(ground);
  Renderer renderer = shown.renderer();
  shown.update(renderer);
  const Image with = renderer.pixels().value();
  renderer.update(ground.view(), {}, {}, shown.bombs, {}, 0);
  const Image without = renderer.pixels().value();
  const auto [x, y] = project(renderer.camera(), shown.bodies[0].position, with.width, with.height);
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  // The ball covers its middle, and where it is it is nearly white.
  EXPECT_EQ(differing(with, without, column - 5, row - 5, column + 5, row + 5), 100);
  EXPECT_GT(with.rgb[3 * static_cast<std::size_t>(row * with.width + column + 15)], 150);
}

TEST(Render, BallShowsThatItRolls) {
  const TestSurface ground = paper_ground();
  Shown shown(ground);
  const Image before = shown.draw();
  shown.bodies[0].orientation = {.x = 0, .y = std::sin(0.3), .z = 0, .w = std::cos(0.3)};
  EXPECT_GT(differing(before, shown.draw()), 100);
}

class RenderShapes : public testing::TestWithParam<Quality> {
 protected:
  // `bodies` above flat ground, always seen from the same place.
  Image draw(const std::vector<BodyView>& bodies) const {
    auto renderer = Renderer::create({.width = 320, .height = 180, .quality = GetParam(), .camera = kCamera}).value();
    renderer.update(ground_.view(), {}, bodies, {}, {}, 0);
    return renderer.pixels().value();
  }
  BodyView body(const Shape& shape, double radius) const {
    BodyView body;
    body.radius = radius;
    body.position = ground_.place(0, 0, 60);
    body.shape = std::make_shared<const Shape>(shape);
    return body;
  }
  // Pixels that differ within 4 x 4 about a place in the picture.
  int differing_at(const Image& a, const Image& b, double x, double y, double z) const {
    const auto [column, row] = project(kCamera, ground_.place(x, y, z), a.width, a.height);
    const int c = static_cast<int>(column), r = static_cast<int>(row);
    return differing(a, b, c - 2, r - 2, c + 2, r + 2);
  }

  const TestSurface ground_ = paper_ground();
  const Camera kCamera = {.eye = ground_.place(150, -500, 300), .target = ground_.place(0, 0, 30)};
};

TEST_P(RenderShapes, BoxesAreLongAndThrowShadows) {
  const Image bare = draw({}), box = draw({body(Box{{160, 40, 40}}, 85)});
  for (const double x : {-70.0, 0.0, 70.0}) EXPECT_EQ(differing_at(bare, box, x, 0, 60), 16) << x;
  EXPECT_EQ(differing_at(bare, box, 0, 0, 110), 0) << "a ball would be as high as it is long";
  // Away from the sun, as far as its height over the tangent of the sun's elevation.
  const double away = 60 / std::tan(29 * std::numbers::pi / 180), azimuth = 68 * std::numbers::pi / 180;
  EXPECT_EQ(differing_at(bare, box, -away * std::sin(azimuth), -away * std::cos(azimuth), 0), 16);
}

TEST_P(RenderShapes, ShadowsKeepUpWithBodies) {
  BodyView box = body(Box{{160, 40, 40}}, 85);
  const RenderOptions options{.width = 320, .height = 180, .quality = GetParam(), .camera = kCamera};
  auto followed = Renderer::create(options).value();
  box.velocity = {0, 200, 0};
  const auto show = [&](double time) {
    followed.update(ground_.view(), {}, std::vector{box}, {}, {}, time);
    return followed.pixels().value();
  };
  show(0);
  box.position.y += 10;
  const Image late = show(0.05);
  EXPECT_LT(differing(late, draw({box})), 20) << "a twentieth of a second is not late";
  box.position.y += 1;
  show(0.055);
  EXPECT_LT(differing(show(0.055), draw({box})), 20) << "it catches up when time stops";
}

TEST_P(RenderShapes, WheelsTurn) {
  BodyView wheel = body(Cylinder{.radius = 50, .length = 30}, 53);
  const Image bare = draw({}), before = draw({wheel});
  EXPECT_EQ(differing_at(bare, before, 0, 0, 60), 16);
  EXPECT_EQ(differing_at(bare, before, 40, 0, 60), 16);
  wheel.orientation = {.x = 0, .y = std::sin(0.1), .z = 0, .w = std::cos(0.1)};
  EXPECT_GT(differing(before, draw({wheel})), 30);
}

TEST_P(RenderShapes, HullsAndCompoundsHaveTheirPartsInPlace) {
  const Hull hull{.points = {{40, 0, -20}, {-20, 35, -20}, {-20, -35, -20}, {0, 0, 50}},
                  .triangles = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}};
  const Image bare = draw({});
  const Image alone = draw({body(hull, 60)});
  EXPECT_EQ(differing_at(bare, alone, 0, 0, 50), 16);
  EXPECT_EQ(differing_at(bare, alone, 30, 0, 95), 0) << "beside the tip";
  const Image pair =
      draw({body(Compound{{{.shape = hull}, {.shape = Capsule{15, 60}, .position = {110, 0, 0}}}}, 130)});
  EXPECT_EQ(differing_at(bare, pair, 0, 0, 50), 16);
  EXPECT_EQ(differing_at(bare, pair, 110, 0, 60), 16);
}

// Loaded on one side, a ball is as large as before and where its middle is.
TEST_P(RenderShapes, LoadedBallsAreNoLarger) {
  Scene scene;
  scene.terrain.shape = GridTerrain{.columns = 37, .rows = 40, .spacing = 10.9};
  scene.bodies = {{.name = "ball", .shape = Sphere{40}, .mass = 45, .position = {0, 0, 60}}};
  const auto view = [&] {
    World world = World::create(scene, std::make_shared<const Jobs>(1)).value();
    auto renderer = Renderer::create({.width = 320, .height = 180, .quality = GetParam(), .camera = kCamera}).value();
    renderer.update(world);
    return renderer.pixels().value();
  };
  const Image even = view();
  scene.bodies[0].center_of_mass = Vec3d{10, 0, -20};
  EXPECT_EQ(differing(even, view()), 0);
}

INSTANTIATE_TEST_SUITE_P(Qualities, RenderShapes, testing::Values(Quality::fast, Quality::fine));

}  // namespace
}  // namespace divot::viewer
