#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "viewer/renderer.h"
#include "viewer/test_pictures.h"

// Asked by the leak checker of sanitized builds: Mesa 22.3 keeps 1 MB of each context that it destroys, whatever was
// drawn.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:swrast_dri.so"; }

namespace divot::viewer {
namespace {

TEST(Render, PictureIsNotBlankAndHasTheSizeAskedFor) {
  const TestSurface ground = paper_ground();
  const Image image = Shown(ground).draw();
  EXPECT_EQ(image.width, 320);
  EXPECT_EQ(image.height, 180);
  ASSERT_EQ(image.rgb.size(), 3u * 320 * 180);
  std::set<std::array<std::uint8_t, 3>> colors;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3)
    colors.insert({image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]});
  EXPECT_GT(colors.size(), 1000u);
}

TEST(Render, OddSizesComeOutWhole) {
  const TestSurface ground = paper_ground();
  auto renderer = Renderer::create({.width = 131, .height = 77}).value();
  renderer.update(ground.view(), {}, {}, {}, {}, 0);
  const Image image = renderer.pixels().value();
  EXPECT_EQ(image.width, 131);
  EXPECT_EQ(image.rgb.size(), 3u * 131 * 77);
}

TEST(Render, SameWorldGivesTheSamePicture) {
  const TestSurface ground = paper_ground();
  EXPECT_EQ(Shown(ground).draw(), Shown(ground).draw());
}

TEST(Render, BombIsSeenUntilItGoesOff) {
  const TestSurface ground = paper_ground();
  Shown shown(ground);
  const Image after = shown.draw();
  shown.bombs = {paper_bomb(ground, false)};
  EXPECT_GT(differing(after, shown.draw()), 20);
}

TEST(Render, WireframeDiffersFromSolid) {
  const TestSurface ground = paper_ground();
  const Image solid = Shown(ground).draw(), wire = Shown(ground).draw({.wireframe = true});
  EXPECT_GT(differing(solid, wire), 320 * 180 / 2);
  // Paper in the corner, and much of the drawing is not paper.
  const std::array<std::uint8_t, 3> corner = {wire.rgb[0], wire.rgb[1], wire.rgb[2]};
  EXPECT_GT(corner[0], 240);
  int inked = 0;
  for (std::size_t i = 0; i < wire.rgb.size(); i += 3) inked += wire.rgb[i] < 200;
  EXPECT_GT(inked, 3000);
}

TEST(Render, TimeIsWrittenWhenAskedFor) {
  const TestSurface ground = paper_ground();
  const Shown shown(ground);
  const Image plain = shown.draw(), captioned = shown.draw({.show_time = true});
  EXPECT_GT(differing(plain, captioned, 0, 140, 80, 180), 100);
  EXPECT_EQ(differing(plain, captioned, 80, 0, 320, 140), 0);

  Renderer renderer = shown.renderer({.show_time = true});
  shown.update(renderer, {}, 1.5);
  EXPECT_GT(differing(renderer.pixels().value(), captioned), 0);
}

TEST(Render, CraterChangesItsRegionAndDirtyUpdateEqualsFullUpdate) {
  TestSurface ground = paper_ground();
  const Shown shown(ground);
  Renderer renderer = shown.renderer();
  shown.update(renderer);
  const Image before = renderer.pixels().value();

  const std::vector<DirtyRange> dirty = ground.dig(0, 0, 122, 24);
  shown.update(renderer, dirty);
  const Image after = renderer.pixels().value();
  const auto [x, y] = project(renderer.camera(), ground.place(0, 0, -10), after.width, after.height);
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  EXPECT_GT(differing(before, after, column - 20, row - 8, column + 20, row + 8), 40 * 16 * 9 / 10);
  // The near corner of the terrain keeps its picture.
  EXPECT_EQ(differing(before, after, 200, 150, 320, 180), 0);

  shown.update(renderer, kAll);
  EXPECT_EQ(renderer.pixels().value(), after);
}

// 82,000 triangles make several chunks; craters lie in one, across a border, and where four meet.
TEST(Render, DirtyUpdateAcrossChunksEqualsFullUpdate) {
  TestSurface ground(200, 207, 2, [](double x, double y) { return 6 * std::sin(x / 40) * std::cos(y / 50); });
  const Shown shown(ground);
  Renderer renderer = shown.renderer();
  shown.update(renderer);
  const Image before = renderer.pixels().value();
  Image previous = before;
  for (const auto& [x, y] : {std::pair(0.0, 0.0), {100.0, 60.0}, {66.0, -70.0}, {-100.0, -100.0}}) {
    const std::vector<DirtyRange> dirty = ground.dig(x, y, 40, 9);
    shown.update(renderer, dirty);
    const Image after = renderer.pixels().value();
    EXPECT_GT(differing(previous, after), 50) << "crater at " << x << ", " << y;
    previous = after;
  }
  shown.update(renderer, kAll);
  EXPECT_EQ(renderer.pixels().value(), previous);
}

TEST(Render, OnlyDirtyVerticesAreTakenOver) {
  TestSurface ground = paper_ground();
  const Shown shown(ground);
  Renderer renderer = shown.renderer();
  shown.update(renderer);
  const Image before = renderer.pixels().value();
  ground.dig(0, 0, 122, 24);
  shown.update(renderer, {});
  EXPECT_EQ(renderer.pixels().value(), before);
}

TEST(Render, OtherTrianglesAreTakenOverWhole) {
  const TestSurface coarse = paper_ground(), fine(73, 79, 5.45, [](double x, double) { return x / 20; });
  Renderer renderer = Shown(coarse).renderer();
  Shown(coarse).update(renderer);
  Shown(fine).update(renderer);
  // A few pixels may differ: shadows and haze keep to what the first update() framed.
  EXPECT_LT(differing(renderer.pixels().value(), Shown(fine).draw({.camera = renderer.camera()})), 100);
}

}  // namespace
}  // namespace divot::viewer
