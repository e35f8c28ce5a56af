#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "divot/world.h"
#include "viewer/renderer.h"
#include "viewer/test_pictures.h"
#include "viewer/textures.h"

namespace divot::viewer {
namespace {

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

}  // namespace
}  // namespace divot::viewer
