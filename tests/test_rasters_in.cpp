// Rasters as they come: mosaics, bands, headerless files of game engines, parts of larger ones, holes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <ranges>

#include "core/gdal.h"
#include "support.h"
#include "terrain/terrain.h"

namespace divot {
namespace {

namespace fs = std::filesystem;

class RastersIn : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              (std::string("divot_rasters_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  // A GeoTIFF in UTM, pixels of 10 m, its north-western corner at 500000 + west, 5000000; `height(column, row)`.
  template <class F>
  void write_tif(const std::string& name, int columns, int rows, F height, double west = 0, int bands = 1,
                 std::initializer_list<const char*> creation = {}) const {
    const core::GdalSession session;
    CPLStringList options;
    for (const char* option : creation) options.AddString(option);
    const GDALDatasetUniquePtr file(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        path(name).c_str(), columns, rows, bands, GDT_Float32, options.List()));
    ASSERT_TRUE(file);
    std::array<double, 6> transform{500000 + west, 10, 0, 5000000, 0, -10};
    file->SetGeoTransform(transform.data());
    OGRSpatialReference utm;
    utm.importFromEPSG(32633);
    file->SetSpatialRef(&utm);
    for (int band = 1; band <= bands; ++band) {
      file->GetRasterBand(band)->SetNoDataValue(-9999);
      for (int row = 0; row < rows; ++row) {
        std::vector<float> line;
        for (int column = 0; column < columns; ++column)
          line.push_back(static_cast<float>(height(column, row) + 1000 * (band - 1)));
        ASSERT_EQ(file->GetRasterBand(band)->RasterIO(GF_Write, 0, row, columns, 1, line.data(), columns, 1,
                                                      GDT_Float32, 0, 0, nullptr),
                  CE_None);
      }
    }
  }

  Result<state::Surface> load(DemTerrain dem, std::uint64_t most = 1'000'000) const {
    Scene scene;
    scene.folder = folder_.string();
    scene.terrain = {.shape = std::move(dem), .max_vertices = most};
    return terrain::load_terrain(scene);
  }
  std::string refused(DemTerrain dem) const {
    const auto surface = load(std::move(dem));
    return surface ? "loaded" : surface.error().front().text().substr(folder_.string().size() + 1);
  }
  fs::path folder_;
};

// Height of the node that came from a column and row, counted from the north-west.
double height_at(const state::Surface& s, std::uint32_t column, std::uint32_t row) {
  return s.position[s.raster->layout.vertex(column, s.raster->layout.rows - 1 - row)].z + s.origin.z;
}

double ramp(int column, int row) { return 100 + column + 0.01 * row; }

TEST_F(RastersIn, TiledCompressedAndASecondBand) {
  write_tif("a.tif", 70, 50, ramp, 0, 2, {"TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16", "COMPRESS=DEFLATE"});
  const auto s = load({.path = "a.tif", .band = 2});
  ASSERT_TRUE(s) << s.error().front().text();
  EXPECT_NEAR(height_at(*s, 69, 49), 1000 + ramp(69, 49), 1e-3);
  EXPECT_EQ(s->raster->x0, 500005);
}

TEST_F(RastersIn, MosaicOfTwoFiles) {
  write_tif("west.tif", 20, 10, ramp);
  write_tif(
      "east.tif", 20, 10, [](int c, int r) { return ramp(c + 20, r); }, 200);
  std::ofstream(path("both.vrt")) << R"(<VRTDataset rasterXSize="40" rasterYSize="10">
    <SRS>EPSG:32633</SRS><GeoTransform>500000, 10, 0, 5000000, 0, -10</GeoTransform>
    <VRTRasterBand dataType="Float32" band="1"><NoDataValue>-9999</NoDataValue>
    <SimpleSource><SourceFilename relativeToVRT="1">west.tif</SourceFilename><SourceBand>1</SourceBand>
      <SrcRect xOff="0" yOff="0" xSize="20" ySize="10"/><DstRect xOff="0" yOff="0" xSize="20" ySize="10"/></SimpleSource>
    <SimpleSource><SourceFilename relativeToVRT="1">east.tif</SourceFilename><SourceBand>1</SourceBand>
      <SrcRect xOff="0" yOff="0" xSize="20" ySize="10"/><DstRect xOff="20" yOff="0" xSize="20" ySize="10"/></SimpleSource>
    </VRTRasterBand></VRTDataset>)";
  const auto s = load({.path = "both.vrt"});
  ASSERT_TRUE(s) << s.error().front().text();
  for (const std::uint32_t column : {0u, 19u, 20u, 39u})
    EXPECT_NEAR(height_at(*s, column, 3), ramp(static_cast<int>(column), 3), 1e-3);
}

// Pixels between nodes have ground where triangles do.
TEST_F(RastersIn, FinerPixelsKeepHoles) {
  write_tif("h.tif", 12, 9, [](int column, int row) {
    return column == 4 && row == 3 ? -9999.0 : column + 0.5 * row + (column == 8 ? row : 0);
  });
  Scene scene;
  scene.folder = folder_.string();
  scene.terrain.shape = DemTerrain{.path = "h.tif"};
  scene.output.raster_spacing = 3;
  const World world = test::make_world(scene);
  const RasterView fine = *world.raster(scene.output.raster_spacing);
  ASSERT_EQ(fine.columns, 45u);
  ASSERT_EQ(fine.rows, 33u);
  std::size_t holes = 0;
  for (std::uint32_t row = 1; row + 1 < fine.rows; ++row)
    for (std::uint32_t column = 1; column + 1 < fine.columns; ++column) {
      const std::size_t pixel = row * fine.columns + column;
      const double ground = world.ground_height(fine.x0 + column * fine.dx, fine.y0 - row * fine.dy);
      holes += fine.holes[pixel];
      if (!fine.holes[pixel] && !std::isnan(ground)) {
        EXPECT_NEAR(fine.heights[pixel], ground, 1e-4);
      }
      EXPECT_EQ(fine.change[pixel], 0);
    }
  // A square with the hole in its middle, whose four corners are cut or not as cells are halved.
  EXPECT_NEAR(static_cast<double>(holes), 25, 12);

  scene.terrain.max_vertices = 45 * 33 - 1;
  const auto refused = World::create(scene);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error()[0].text(),
            "output.raster_spacing: rasters would have 45 x 33 pixels, more than the limit of 1484; expected a larger "
            "spacing or a higher `terrain.max_vertices`");
}

// SRTM says where it lies by its name alone: 3 seconds of arc, 1201 x 1201.
TEST_F(RastersIn, PartOfAnSrtmTile) {
  std::string bytes;
  for (int row = 0; row < 1201; ++row)
    for (int column = 0; column < 1201; ++column) {
      const int z = column == 605 && row == 603 ? -32768 : 200 + column / 4;
      bytes += static_cast<char>(z >> 8 & 0xff), bytes += static_cast<char>(z & 0xff);
    }
  std::ofstream(path("N50E014.hgt"), std::ios::binary) << bytes;
  const auto s = load({.path = "N50E014.hgt", .box = {.west = 14.5, .south = 50.48, .east = 14.52, .north = 50.5}});
  ASSERT_TRUE(s) << s.error().front().text();
  EXPECT_NEAR(s->raster->dx * s->raster->layout.columns, 0.02 * 111320 * std::cos(50.49 * 3.14159 / 180), 150);
  EXPECT_NEAR(s->raster->dy * s->raster->layout.rows, 0.02 * 111240, 150);
  const auto holes = std::ranges::count_if(std::views::iota(0u, s->mesh.vertex_count()),
                                           [&](std::uint32_t v) { return s->mesh.outgoing(v) == kNone; });
  EXPECT_GT(holes, 0);
  const auto filled = load({.path = "N50E014.hgt",
                            .box = {.west = 14.5, .south = 50.48, .east = 14.52, .north = 50.5},
                            .nodata = Nodata::fill});
  ASSERT_TRUE(filled);
  for (std::uint32_t v = 0; v < filled->mesh.vertex_count(); ++v) {
    EXPECT_NE(filled->mesh.outgoing(v), kNone);
    EXPECT_NEAR(filled->position[v].z + filled->origin.z, 350, 8);
  }
}

TEST_F(RastersIn, HeightmapsOfEngines) {
  std::string bytes;
  for (int row = 0; row < 12; ++row)
    for (int column = 0; column < 20; ++column) {
      const int number = 1000 * column + row;
      bytes += static_cast<char>(number & 0xff), bytes += static_cast<char>(number >> 8 & 0xff);
    }
  std::ofstream(path("a.r16"), std::ios::binary) << bytes;
  DemTerrain dem{.path = "a.r16", .pixel = 2, .raw_columns = 20, .height_scale = 0.01, .height_offset = -50};
  const auto s = load(dem);
  ASSERT_TRUE(s) << s.error().front().text();
  EXPECT_EQ(s->raster->layout.columns, 20u);
  EXPECT_EQ(s->raster->x0, -19);
  EXPECT_EQ(s->raster->dx, 2);
  EXPECT_NEAR(height_at(*s, 19, 11), 190.11 - 50, 1e-4);
  EXPECT_NEAR(height_at(*s, 0, 0), -50, 1e-4);
  dem.raw_columns = 0;
  EXPECT_EQ(refused(dem),
            "a.r16: terrain.raw_columns: 480 bytes are no square of 16-bit numbers; expected `raw_columns`, "
            "of which the file holds whole rows");
  dem.raw_columns = 20, dem.pixel = 0;
  EXPECT_NE(refused(dem).find("or `pixel = 1.0` for metres"), std::string::npos);

  // A 16-bit PNG has no place either.
  const core::GdalSession session;
  const GDALDatasetUniquePtr whole(
      GetGDALDriverManager()->GetDriverByName("MEM")->Create("", 9, 9, 1, GDT_UInt16, nullptr));
  std::vector<std::uint16_t> numbers(81);
  for (std::size_t k = 0; k < 81; ++k) numbers[k] = static_cast<std::uint16_t>(700 * k);
  ASSERT_EQ(whole->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, 9, 9, numbers.data(), 9, 9, GDT_UInt16, 0, 0, nullptr),
            CE_None);
  {
    const GDALDatasetUniquePtr png(GetGDALDriverManager()->GetDriverByName("PNG")->CreateCopy(
        path("a.png").c_str(), whole.get(), FALSE, nullptr, nullptr, nullptr));
  }
  const auto p = load({.path = "a.png", .pixel = 0.05, .height_scale = 0.001});
  ASSERT_TRUE(p) << p.error().front().text();
  EXPECT_NEAR(height_at(*p, 8, 8), 56, 1e-4);
  EXPECT_NEAR(p->spacing, 0.05, 1e-6);
}

TEST_F(RastersIn, WindowsAndBoxes) {
  write_tif("a.tif", 70, 50, ramp);
  const auto w = load({.path = "a.tif", .window = {.column = 10, .row = 20, .columns = 30}});
  ASSERT_TRUE(w) << w.error().front().text();
  EXPECT_EQ(w->raster->layout.columns, 30u);
  EXPECT_EQ(w->raster->layout.rows, 30u);
  EXPECT_EQ(w->raster->x0, 500105);
  EXPECT_NEAR(height_at(*w, 0, 0), ramp(10, 20), 1e-3);
  // The same by its borders.
  const auto b = load({.path = "a.tif", .box = {.west = 500100, .south = 4999500, .east = 500400, .north = 4999800}});
  ASSERT_TRUE(b) << b.error().front().text();
  EXPECT_EQ(b->position, w->position);
  EXPECT_EQ(b->raster->y0, w->raster->y0);
  EXPECT_EQ(refused({.path = "a.tif", .window = {.column = 60, .row = 0, .columns = 11}}),
            "a.tif: terrain.window: reaches beyond the file; expected a part of its 70 x 50 pixels");
  EXPECT_EQ(refused({.path = "a.tif", .box = {.west = 0, .south = 0, .east = 10, .north = 10}}),
            "a.tif: terrain.box: lies beside the file; expected it within x 500000 to 500700, y 4999500 to 5000000");
}

// 10^8 pixels are never in memory: the limit counts what is left at the spacing asked for.
TEST_F(RastersIn, ALargeOneIsReadCoarsely) {
  std::ofstream(path("large.vrt")) << R"(<VRTDataset rasterXSize="12000" rasterYSize="10000">
    <SRS>EPSG:32633</SRS><GeoTransform>500000, 10, 0, 5000000, 0, -10</GeoTransform>
    <VRTRasterBand dataType="Float32" band="1"><SimpleSource><SourceFilename relativeToVRT="1">a.tif</SourceFilename>
      <SourceBand>1</SourceBand><SrcRect xOff="0" yOff="0" xSize="120" ySize="100"/>
      <DstRect xOff="0" yOff="0" xSize="12000" ySize="10000"/></SimpleSource></VRTRasterBand></VRTDataset>)";
  write_tif("a.tif", 120, 100, ramp);
  const auto s = load({.path = "large.vrt", .spacing = 1000}, 60'000);
  ASSERT_TRUE(s) << s.error().front().text();
  EXPECT_EQ(s->raster->dx, 1000);
  EXPECT_NEAR(s->raster->layout.columns, 120, 1);
  EXPECT_NEAR(height_at(*s, 60, 50), ramp(60, 50), 1.5);
  EXPECT_NE(refused({.path = "large.vrt"}).find("are more than the limit"), std::string::npos);
}

}  // namespace
}  // namespace divot
