#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "viewer/image.h"
#include "viewer/renderer.h"
#include "viewer/test_pictures.h"

namespace divot::viewer {
namespace {

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

}  // namespace
}  // namespace divot::viewer
