#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "support.h"
#include "terrain/material_map.h"

namespace divot::test {
namespace {

// A folder of its own for the files of each test.
class MaterialMapTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("divot_map_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  // A grey image without a place of its own: `rows` of characters, each the value of a pixel.
  void write_grey(const std::string& name, const std::vector<std::string>& rows) {
    std::string bytes = "P5\n" + std::to_string(rows[0].size()) + " " + std::to_string(rows.size()) + "\n255\n";
    for (const std::string& row : rows) bytes += row;
    write(name, bytes);
  }

  // Flat ground of 6 x 4 vertices, 1 m apart, with a map.
  Scene grid_scene(const std::string& image, const std::vector<LegendEntry>& legend) {
    Scene scene;
    scene.folder = folder_.string();
    scene.terrain = {.shape = GridTerrain{.columns = 6, .rows = 4, .spacing = 1}, .material = "dry_sand"};
    scene.terrain.material_map = {.image = image, .legend = legend};
    return scene;
  }

  // Names of the materials at the grid's vertices by their first letter, from the north as an image is.
  static std::string letters(const World& world, std::uint32_t columns, std::uint32_t rows) {
    const state::GridLayout layout{columns, rows};
    std::string out;
    for (std::uint32_t row = rows; row-- > 0; out += '\n')
      for (std::uint32_t column = 0; column < columns; ++column)
        out += world.materials()[world.surface().materials[layout.vertex(column, row)]].name[0];
    return out;
  }

  // The only error that making a world of it gives.
  static std::string error_of(const Scene& scene) {
    const auto world = World::create(scene);
    EXPECT_FALSE(world);
    if (world) return {};
    EXPECT_EQ(world.error().size(), 1u);
    Error error = world.error().front();
    error.file = std::filesystem::path(error.file).filename().string();
    return error.text();
  }

  std::filesystem::path folder_;
};

TEST_F(MaterialMapTest, StretchesOverTheGridWithSharpBorders) {
  write_grey("map.pgm", {"aab", "bba"});
  const Scene scene = grid_scene("map.pgm", {{.pixel = 'a', .material = "mud"}, {.pixel = 'b', .material = "asphalt"}});
  const World world = make_world(scene);
  EXPECT_EQ(letters(world, 6, 4), "mmmmaa\nmmmmaa\naaaamm\naaaamm\n");
  ASSERT_EQ(world.materials().size(), 3u);
  EXPECT_EQ(world.materials()[0].name, "dry_sand");
  EXPECT_EQ(world.materials()[1].name, "mud");
}

TEST_F(MaterialMapTest, TakesPixelForVertexWhereTheyAreAsMany) {
  write_grey("map.pgm", {"aaabab", "bbbbbb", "aaaaab", "babbbb"});
  const Scene scene = grid_scene("map.pgm", {{.pixel = 'a', .material = "mud"}, {.pixel = 'b', .material = "snow"}});
  EXPECT_EQ(letters(make_world(scene), 6, 4), "mmmsms\nssssss\nmmmmms\nsmssss\n");
}

TEST_F(MaterialMapTest, ReadsColours) {
  write("map.ppm", std::string("P6\n2 1\n255\n") + "\x10\x20\x30" + "\xff\xc0\x80");
  const Scene scene = grid_scene("map.ppm", {{.color = true, .pixel = 0x102030, .material = "mud"},
                                             {.color = true, .pixel = 0xffc080, .material = "rock"}});
  EXPECT_EQ(letters(make_world(scene), 6, 4), "mmmrrr\nmmmrrr\nmmmrrr\nmmmrrr\n");
}

// An Esri grid says where it lies: here over three columns in the middle, with a hole.
TEST_F(MaterialMapTest, IsPlacedWhereItSaysAndLeavesTheRest) {
  write("map.asc", "ncols 3\nnrows 2\nxllcorner -1.6\nyllcorner -1\ncellsize 1\nNODATA_value -1\n7 7 8\n8 -1 7\n");
  const Scene scene = grid_scene("map.asc", {{.pixel = 7, .material = "mud"}, {.pixel = 8, .material = "rock"}});
  // Vertices stand at x = -2.5 ... 2.5 and y = -1.5 ... 1.5.
  EXPECT_EQ(letters(make_world(scene), 6, 4), "dddddd\ndmmrdd\ndrdmdd\ndddddd\n");
}

// Model and map in degrees: the model becomes metres, and the map follows.
TEST_F(MaterialMapTest, FollowsAModelInDegrees) {
  std::string heights, zones = "1 2\n";
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 20; ++column) heights += "5 ";
    heights += '\n';
  }
  write("dem.asc", "ncols 20\nnrows 20\nxllcorner 14\nyllcorner 50\ncellsize 0.001\n" + heights);
  write("map.asc", "ncols 2\nnrows 1\nxllcorner 14\nyllcorner 50\ndx 0.01\ndy 0.02\n" + zones);
  Scene scene = grid_scene("map.asc", {{.pixel = 1, .material = "mud"}, {.pixel = 2, .material = "rock"}});
  scene.terrain.shape = DemTerrain{.path = "dem.asc", .crs = "EPSG:4326"};
  const World world = make_world(scene);
  std::size_t west = 0, east = 0;
  for (std::size_t v = 0; v < world.surface().positions.size(); ++v) {
    const double x = world.surface().positions[v].x + world.surface().origin.x;
    const std::string& name = world.materials()[world.surface().materials[v]].name;
    if (std::abs(x) < 10) continue;  // at the border the two projections may differ by a pixel's rounding
    EXPECT_EQ(name, x < 0 ? "mud" : "rock") << x;
    ++(x < 0 ? west : east);
  }
  EXPECT_GT(west, 100u);
  EXPECT_GT(east, 100u);
}

TEST_F(MaterialMapTest, ErrorsNameValueAndPlace) {
  write_grey("map.pgm", {"aab", "bca"});
  write("colour.ppm", std::string("P6\n2 1\n255\n") + "\x10\x20\x30" + "\xff\xc0\x80");
  write("far.asc", "ncols 2\nnrows 2\nxllcorner 500\nyllcorner 0\ncellsize 1\n7 7\n7 7\n");
  write("broken.png", "not a picture");
  const LegendEntry a{.pixel = 'a', .material = "mud"}, b{.pixel = 'b', .material = "rock"},
      c{.pixel = 'c', .material = "snow"}, d{.pixel = 5, .material = "snow"},
      red{.color = true, .pixel = 0xff0000, .material = "mud"};
  EXPECT_EQ(error_of(grid_scene("map.pgm", {a, b})),
            "map.pgm: terrain.material_map.legend: has no entry for 99, which is in column 1, row 1 of the image, "
            "counted from 0 at its first corner; expected only 97 or 98 there, or an entry for it");
  EXPECT_EQ(error_of(grid_scene("map.pgm", {a, b, c, d})),
            "map.pgm: terrain.material_map.legend: no pixel of the image is 5; expected it left out: the image holds "
            "97, 98 or 99");
  EXPECT_EQ(error_of(grid_scene("map.pgm", {red})),
            "map.pgm: terrain.material_map.legend: the image has no colours of 8 bits; expected numbers for its "
            "pixels");
  EXPECT_EQ(error_of(grid_scene("colour.ppm", {a})),
            "colour.ppm: terrain.material_map.legend: the image is in colour; expected colours as \"#8a6f4d\" for its "
            "pixels");
  EXPECT_EQ(error_of(grid_scene("colour.ppm", {red})).substr(0, 65),
            "colour.ppm: terrain.material_map.legend: has no entry for #102030");
  EXPECT_EQ(error_of(grid_scene("none.png", {a})), "none.png: terrain.material_map.image: the file does not exist");
  EXPECT_NE(error_of(grid_scene("broken.png", {a})).find("not a raster that can be read"), std::string::npos);
  EXPECT_NE(
      error_of(grid_scene("far.asc", {{.pixel = 7, .material = "mud"}}))
          .find("lies beside the terrain: x from 500 to 502, y from 0 to 2, where the terrain has x from -3 to 3"),
      std::string::npos);
  // Refused before memory is taken.
  write("huge.pgm", "P5\n60000 60000\n255\n");
  EXPECT_EQ(error_of(grid_scene("huge.pgm", {a})),
            "huge.pgm: terrain.material_map.image: 60000 x 60000 are 3600000000 pixels; expected at most "
            "terrain.max_vertices, which is 20000000");
}

TEST_F(MaterialMapTest, MeshesBringAListOfTheirOwn) {
  Scene scene;
  scene.materials = {*find_preset("mud"), *find_preset("asphalt")};
  MeshTerrain mesh{.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, .triangles = {0, 1, 2, 0, 2, 3}};
  mesh.materials = {0, 1, 1, 0};
  scene.terrain = {.shape = mesh, .material = "mud"};
  const World world = make_world(scene);
  for (std::size_t v = 0; v < 4; ++v)
    EXPECT_EQ(world.materials()[world.surface().materials[v]].name, mesh.materials[v] == 0 ? "mud" : "asphalt") << v;

  mesh.materials = {0, 1, 2, 0};
  scene.terrain.shape = mesh;
  EXPECT_EQ(error_of(scene),
            "terrain.mesh.materials: vertex 2 has the material 2, and the scene defines 2; expected "
            "an index into Scene::materials");
  mesh.materials = {0, 1};
  scene.terrain.shape = mesh;
  EXPECT_EQ(error_of(scene), "terrain.mesh.materials: holds 2 for 4 vertices; expected one for every vertex, or none");
}

// A ball rolls off a road into mud: its rut begins within a spacing of the border.
TEST_F(MaterialMapTest, RutsEndAtTheBorder) {
  write_grey("map.pgm", {"ab"});
  Scene scene = grid_scene("map.pgm", {{.pixel = 'a', .material = "asphalt"}, {.pixel = 'b', .material = "mud"}});
  scene.duration = 2;
  constexpr double kSpacing = 0.1;
  scene.terrain.shape = GridTerrain{.columns = 80, .rows = 30, .spacing = kSpacing};
  scene.bodies = {{.name = "ball",
                   .shape = Sphere{0.4},
                   .mass = 300,
                   .position = {-2.5, 0, 0},
                   .above_ground = true,
                   .velocity = {3, 0, 0},
                   .angular_velocity = {0, 7.5, 0}}};
  World world = make_world(scene);
  run_to(world, 2);
  float road = 0, mud = 0;
  for (std::uint32_t v = 0; v < world.surface().positions.size(); ++v) {
    const float x = world.surface().positions[v].x, sunk = world.sinkage(v);
    if (x < -kSpacing) road = std::max(road, sunk);
    if (x > kSpacing) mud = std::max(mud, sunk);
  }
  EXPECT_LT(road, 3e-3) << "a ball bears on a point";
  EXPECT_GT(mud, 0.02);
}

}  // namespace
}  // namespace divot::test
