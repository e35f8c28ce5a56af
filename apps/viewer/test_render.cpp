#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>

#include "divot/world.h"
#include "viewer/renderer.h"
#include "viewer/test_surface.h"
#include "viewer/textures.h"

// Asked by the leak checker of sanitized builds: Mesa 22.3 keeps 1 MB of each context that it destroys, whatever was
// drawn.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:swrast_dri.so"; }

namespace divot::viewer {
namespace {

TestSurface paper_ground() {
  return TestSurface(37, 40, 10.9, [](double, double) { return 0.0; });
}

// The paper's ball beside the crater to come.
BodyView paper_ball(const TestSurface& ground) {
  BodyView ball;
  ball.radius = 75;
  ball.position = ground.place(-150, 20, 76);
  return ball;
}

BombView paper_bomb(const TestSurface& ground, bool exploded) {
  BombView bomb;
  bomb.position = ground.place(0, 0, 10);
  bomb.yield = 5000;
  bomb.exploded = exploded;
  return bomb;
}

// Ranges that hold every vertex there can be.
constexpr std::array<DirtyRange, 1> kAll = {DirtyRange{0, 0xffffffffu}};

// What a test shows; drawn small, as the software driver is slow.
struct Shown {
  explicit Shown(const TestSurface& on) : ground(on), bodies{paper_ball(on)}, bombs{paper_bomb(on, true)} {}

  Renderer renderer(RenderOptions options = {}) const {
    options.width = 320;
    options.height = 180;
    auto made = Renderer::create(options);
    if (!made) throw std::runtime_error(made.error().front().text());
    return std::move(*made);
  }
  void update(Renderer& renderer, std::span<const DirtyRange> dirty = {}, double time = 0) const {
    renderer.update(
        ground.view(), dirty, bodies, bombs, [&](std::uint32_t v) { return ground.sinkage(v); }, time);
  }
  Image draw(const RenderOptions& options = {}) const {
    Renderer made = renderer(options);
    update(made);
    return made.pixels().value();
  }

  const TestSurface& ground;
  std::vector<BodyView> bodies;
  std::vector<BombView> bombs;
};

// Pixels that differ by more than rounding, within columns [left, right) and rows [top, bottom).
int differing(const Image& a, const Image& b, int left, int top, int right, int bottom) {
  int count = 0;
  for (int row = top; row < bottom; ++row) {
    for (int column = left; column < right; ++column) {
      int largest = 0;
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const std::size_t i =
            3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(a.width) + column) + channel;
        largest = std::max(largest, std::abs(a.rgb[i] - b.rgb[i]));
      }
      count += largest > 2;
    }
  }
  return count;
}

int differing(const Image& a, const Image& b) { return differing(a, b, 0, 0, a.width, a.height); }

// Where a point of the terrain appears in a picture of `camera`.
std::pair<double, double> project(const Camera& camera, const Vec3d& point, int width, int height) {
  const Vec3d toward = camera.target - camera.eye, forward = toward * (1 / length(toward));
  const Vec3d side = cross(forward, {0, 0, 1}), right = side * (1 / length(side)), up = cross(right, forward);
  const Vec3d p = point - camera.eye;
  const double scale = height / 2.0 / std::tan(camera.fov_deg * std::numbers::pi / 360) / dot(p, forward);
  return {width / 2.0 + scale * dot(p, right), height / 2.0 - scale * dot(p, up)};
}

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

// Share of pixels for which `is(red, green, blue)` holds.
template <class Is>
double share(const Image& image, const Is& is) {
  int count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) count += is(image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]);
  return 3.0 * count / static_cast<double>(image.rgb.size());
}

constexpr auto kIsRed = [](int r, int g, int b) { return r > 2 * g && r > 2 * b; };
constexpr auto kIsBlue = [](int r, int g, int b) { return b > 2 * r && b > 2 * g; };

// A plain of one material that looks like this.
Image draw_plain(const std::string& look, Quality quality, const std::string& folder) {
  const std::string text =
      "terrain.grid = { columns = 37, rows = 40, spacing = 10.9 }\nterrain.material = \"x\"\n"
      "[materials.x]\n" +
      look;
  World world = World::create(parse_scene(text, folder + "/plain.toml").value()).value();
  EXPECT_TRUE(check_textures(world.materials(), world.scene().folder));
  auto renderer = Renderer::create({.width = 320, .height = 180, .quality = quality}).value();
  renderer.update(world);
  return renderer.pixels().value();
}

class RenderLooks : public testing::TestWithParam<Quality> {};

TEST_P(RenderLooks, ColoursAreThoseOfTheMaterial) {
  const Image red = draw_plain("color = \"#c02010\"", GetParam(), ".");
  EXPECT_GT(share(red, kIsRed), 0.3);
  EXPECT_EQ(share(red, kIsBlue), 0);
  EXPECT_GT(share(draw_plain("color = \"#1020c0\"", GetParam(), "."), kIsBlue), 0.3);
  EXPECT_EQ(share(draw_plain("", GetParam(), "."), kIsRed), 0);
}

TEST_P(RenderLooks, TexturesLieOnTheGround) {
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("divot_looks_{}", getpid());
  std::filesystem::create_directories(folder);
  Image half{.width = 64, .height = 64};
  for (int i = 0; i < 64 * 64; ++i) {
    const bool left = i % 64 < 32;
    half.rgb.insert(half.rgb.end(),
                    {static_cast<std::uint8_t>(left ? 200 : 20), 20, static_cast<std::uint8_t>(left ? 20 : 200)});
  }
  ASSERT_TRUE(write_png(half, folder / "half.png"));
  const Image image = draw_plain("texture = \"half.png\"\ntexture_size = 200", GetParam(), folder);
  EXPECT_GT(share(image, kIsRed), 0.1);
  EXPECT_GT(share(image, kIsBlue), 0.1);
  std::ofstream(folder / "half.png") << "no picture";
  const Material bad{.name = "x", .texture = "half.png"};
  const auto read = check_textures({&bad, 1}, folder);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().front().key, "materials.x.texture");
  std::filesystem::remove_all(folder);
}

// Two materials meet in a sharp line, also where three do and across chunks.
TEST_P(RenderLooks, MaterialsMeetSharply) {
  TestSurface ground(73, 79, 5.45, [](double, double) { return 0; });
  const auto draw = [&] {
    auto renderer =
        Renderer::create({.width = 320, .height = 180, .color = ColorBy::material, .quality = GetParam()}).value();
    renderer.update(ground.view(), {}, {}, {}, {}, 0);
    return renderer.pixels().value();
  };
  const auto hues = [](const Image& image) {
    std::map<std::array<int, 3>, int> count;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
      const int most = std::max(
          {1, static_cast<int>(image.rgb[i]), static_cast<int>(image.rgb[i + 1]), static_cast<int>(image.rgb[i + 2])});
      std::array<int, 3> hue;
      for (std::size_t k = 0; k < 3; ++k) hue[k] = 8 * image.rgb[i + k] / most;
      ++count[hue];
    }
    return count;
  };
  const auto one = hues(draw());
  ground.set_materials([](double x, double y) { return static_cast<std::uint8_t>(x < -20 ? 0 : y < 13 ? 1 : 2); });
  const Image three = draw();
  int blended = 0, all = 0;
  std::vector<int> large;
  for (const auto& [hue, count] : hues(three)) {
    all += count;
    if (count > 1000) large.push_back(count);
    if (count < 200 && !one.contains(hue)) blended += count;
  }
  EXPECT_GE(large.size(), 4u) << "three materials and sky";
  EXPECT_LT(blended, all / 50);
}

INSTANTIATE_TEST_SUITE_P(Qualities, RenderLooks, testing::Values(Quality::fast, Quality::fine));

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

INSTANTIATE_TEST_SUITE_P(Qualities, RenderShapes, testing::Values(Quality::fast, Quality::fine));

// A bomb breaks a road: what was followed by dirty ranges looks as what is seen for the first time.
TEST(Render, BrokenRoadsShowWhatLiesBelow) {
  Scene scene;
  Material road = *find_preset("asphalt");
  road.name = "road", road.over = "clay_wet", road.over_thickness = 0.1;
  scene.materials = {road};
  scene.terrain = {.shape = GridTerrain{.columns = 81, .rows = 81, .spacing = 0.4}, .material = "road"};
  scene.bombs = {{.time = 0.1, .position = {}, .above_ground = true, .yield = 1}};
  World world = World::create(scene, std::make_shared<const Jobs>(1)).value();
  RenderOptions options{.width = 320, .height = 180, .color = ColorBy::material, .effects = false};
  auto followed = Renderer::create(options).value();
  followed.update(world);
  options.camera = followed.camera();
  const Image whole = followed.pixels().value();
  while (world.time() < 1) world.step();
  followed.update(world);
  const Image broken = followed.pixels().value();
  auto fresh = Renderer::create(options).value();
  fresh.update(world);
  EXPECT_LT(differing(broken, fresh.pixels().value()), 320 * 180 / 100);
  EXPECT_GT(differing(whole, broken), 320 * 180 / 10);
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

TEST(Render, FileIsWrittenAndNothingElseIsLeft) {
  const TestSurface ground = paper_ground();
  const auto folder = std::filesystem::temp_directory_path() / "divot_render_test";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  Renderer renderer = Shown(ground).renderer();
  Shown(ground).update(renderer);
  ASSERT_TRUE(renderer.write_png((folder / "a.png").string()));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()), 1);
  std::ifstream file(folder / "a.png", std::ios::binary);
  std::string start(8, ' ');
  file.read(start.data(), 8);
  EXPECT_EQ(start, "\x89PNG\r\n\x1a\n");
  std::filesystem::remove_all(folder);
}

TEST(Render, UnwritablePathIsAnError) {
  const Image image{.width = 1, .height = 1, .rgb = {1, 2, 3}};
  const auto written = write_png(image, "/nowhere/at/all.png");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error()[0].text(),
            "/nowhere/at/all.png: cannot be written; a folder that exists and may be written to");
  EXPECT_FALSE(write_png(Image{}, "empty.png"));
}

TEST(Render, OptionsOutOfRangeAreErrors) {
  EXPECT_FALSE(Renderer::create({.width = 0}));
  EXPECT_FALSE(Renderer::create({.height = 100000}));
  EXPECT_FALSE(Renderer::create({.sun_elevation_deg = -5}));
}

TEST(Render, SheetHoldsEveryPicture) {
  const Image red{.width = 2, .height = 1, .rgb = {255, 0, 0, 255, 0, 0}};
  const Image blue{.width = 2, .height = 1, .rgb = {0, 0, 255, 0, 0, 255}};
  const std::vector<Image> three = {red, blue, red};
  const Image sheet = contact_sheet(three, {.columns = 2, .margin = 1}).value();
  EXPECT_EQ(sheet.width, 7);
  EXPECT_EQ(sheet.height, 5);
  const auto pixel = [&](int column, int row) {
    const std::size_t i = 3 * static_cast<std::size_t>(row * sheet.width + column);
    return std::array<int, 3>{sheet.rgb[i], sheet.rgb[i + 1], sheet.rgb[i + 2]};
  };
  const std::array<int, 3> white = {255, 255, 255};
  EXPECT_EQ(pixel(1, 1), (std::array<int, 3>{255, 0, 0}));
  EXPECT_EQ(pixel(3, 1), white);
  EXPECT_EQ(pixel(5, 1), (std::array<int, 3>{0, 0, 255}));
  EXPECT_EQ(pixel(2, 3), (std::array<int, 3>{255, 0, 0}));
  EXPECT_EQ(pixel(5, 3), white);
  EXPECT_FALSE(contact_sheet({}, {}));
  EXPECT_FALSE(contact_sheet(three, {.columns = 0}));
}

TEST(Framing, AllOfASmallTerrainIsInThePicture) {
  const TestSurface ground = paper_ground();
  const Shown shown(ground);
  const Framing framing = frame(ground.view(), shown.bodies, shown.bombs);
  for (const double x : {-196.0, 196.0}) {
    for (const double y : {-212.0, 212.0}) {
      const auto [column, row] = project(framing.camera, ground.place(x, y, 0), 1280, 720);
      EXPECT_TRUE(column > 0 && column < 1280 && row > 0 && row < 720) << column << ", " << row;
    }
  }
  const auto [column, top] = project(framing.camera, shown.bodies[0].position + Vec3d{0, 0, 75}, 1280, 720);
  EXPECT_TRUE(top > 0 && column > 0);
}

TEST(Framing, LargeTerrainShowsWhereThingsHappen) {
  const TestSurface ground(60, 60, 500, [](double, double) { return 0.0; });
  BombView bomb = paper_bomb(ground, false);
  bomb.position = ground.place(3000, -2000, 0);
  const Framing framing = frame(ground.view(), {}, std::span(&bomb, 1));
  EXPECT_LT(length(framing.camera.eye - bomb.position), 1500);
  // The crater to come has equal room on both sides.
  const Vec3d toward = framing.camera.target - framing.camera.eye;
  const Vec3d ahead = Vec3d{toward.x, toward.y, 0} * (122 / std::hypot(toward.x, toward.y));
  const Vec3d right = cross(ahead, {0, 0, 1});
  const auto at = [&](const Vec3d& from_bomb) { return project(framing.camera, bomb.position + from_bomb, 1280, 720); };
  EXPECT_NEAR(at(right).first + at(-right).first, 1280, 30);
  EXPECT_NEAR(at(ahead).second + at(-ahead).second, 720, 30);
  EXPECT_GT(at(right).first - at(-right).first, 720);
}

TEST(Framing, NothingAtAllStillHasACamera) {
  const Framing framing = frame(SurfaceView{}, {}, {});
  EXPECT_TRUE(is_finite(framing.camera.eye));
  EXPECT_NE(framing.camera.eye, framing.camera.target);
}

}  // namespace
}  // namespace divot::viewer
