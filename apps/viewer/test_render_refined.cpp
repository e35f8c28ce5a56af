#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "divot/world.h"
#include "viewer/test_pictures.h"

namespace divot::viewer {
namespace {

// A ball rolls over ground that is refined under it: what was followed from picture to picture looks as what is seen
// for the first time, and the lines in its rut lie close.
TEST(Render, NewTrianglesAreFollowed) {
  const auto run = [](double min_edge, auto show) {
    Scene scene;
    scene.terrain = {.shape = GridTerrain{.columns = 17, .rows = 9, .spacing = 0.8},
                     .material = "dry_sand",
                     .refine = {.min_edge = min_edge, .error = 0.002, .tolerance = 1e-4}};
    scene.bodies = {{.shape = Sphere{.radius = 0.4},
                     .mass = 250,
                     .position = {-4, 0.03, 0},
                     .above_ground = true,
                     .velocity = {4, 0, 0},
                     .angular_velocity = {0, 10, 0}}};
    World world = World::create(scene, std::make_shared<const Jobs>(1)).value();
    while (world.time() < 1.5) {
      for (int k = 0; k < 5; ++k) world.step();
      show(world);
    }
    return world;
  };
  RenderOptions options{.width = 640, .height = 360, .wireframe = true, .effects = false};
  std::optional<Renderer> followed;
  World refined = run(0.025, [&](World& world) {
    if (!followed) followed.emplace(Renderer::create(options).value());
    followed->update(world);
  });
  ASSERT_GT(refined.surface().triangles.size() / 3, 9000u) << "more than one chunk holds";
  ASSERT_GT(refined.refinement().joined, 0u);
  options.camera = followed->camera();
  const auto draw = [&](World& world) {
    auto fresh = Renderer::create(options).value();
    fresh.update(world);
    return fresh.pixels().value();
  };
  const Image wire = followed->pixels().value();
  // Where lines cross, which lies on top depends on the order in which triangles came.
  EXPECT_LT(differing(wire, draw(refined)), 20);

  World coarse = run(0, [](World&) {});
  const auto [x, y] = project(followed->camera(), {-3, 0, 0}, 640, 360);
  const auto inked = [&, column = static_cast<int>(x), row = static_cast<int>(y)](const Image& image) {
    int count = 0;
    for (int r = row - 4; r < row + 4; ++r)
      for (int c = column - 12; c < column + 12; ++c) count += image.rgb[3 * (r * 640 + c)] < 200;
    return count;
  };
  EXPECT_GT(inked(wire), 2 * inked(draw(coarse)) + 20);
}

}  // namespace
}  // namespace divot::viewer
