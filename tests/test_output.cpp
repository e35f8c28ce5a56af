#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "core/gdal.h"
#include "output/atomic_file.h"
#include "output/csv.h"
#include "output/heading.h"
#include "output/json.h"
#include "output/ply.h"
#include "output/raster_file.h"
#include "output/resample.h"
#include "source_dir.h"
#include "terrain/dem_file.h"
#include "terrain/terrain.h"

namespace divot {
namespace {

namespace fs = std::filesystem;
using state::Surface;

// A folder of its own for each test, gone when the test is over.
class Output : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              (std::string("divot_output_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t file_count() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

std::string slurp(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Surface grid(int columns, int rows, double spacing, std::function<double(double, double)> height = {}) {
  Scene scene;
  scene.terrain.shape = GridTerrain{.columns = columns, .rows = rows, .spacing = spacing, .height = std::move(height)};
  auto surface = terrain::load_terrain(scene);
  EXPECT_TRUE(surface);
  return std::move(*surface);
}

SurfaceView view(const Surface& s) {
  return {.origin = s.origin,
          .positions = s.position,
          .triangles = s.mesh.triangles(),
          .materials = s.material,
          .spacing = s.spacing};
}

Result<void> write_heights(const std::string& path, const RasterView& raster) {
  return output::write_geotiff(path, raster, raster.heights);
}

// --- files that appear whole or not at all ---

TEST_F(Output, FileAppearsOnCommitOnly) {
  std::ofstream(path("a.txt")) << "before";
  {
    auto file = output::AtomicFile::create(path("a.txt"));
    ASSERT_TRUE(file);
    file->write("half of");
    EXPECT_EQ(slurp(path("a.txt")), "before");
  }
  EXPECT_EQ(slurp(path("a.txt")), "before");
  EXPECT_EQ(file_count(), 1u);

  auto file = output::AtomicFile::create(path("a.txt"));
  ASSERT_TRUE(file);
  file->write("all of it");
  EXPECT_TRUE(file->commit());
  EXPECT_EQ(slurp(path("a.txt")), "all of it");
  EXPECT_EQ(file_count(), 1u);
}

TEST_F(Output, FolderThatCannotBeWrittenIsNamed) {
  const auto missing = output::AtomicFile::create(path("no/such/folder/a.txt"));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().front().file, path("no/such/folder/a.txt"));
  EXPECT_NE(missing.error().front().text().find("No such file"), std::string::npos);

  std::ofstream(path("file")) << "x";
  EXPECT_NE(output::make_folder(path("file/sub")).error().front().text().find("Not a directory"), std::string::npos);
  EXPECT_TRUE(output::make_folder(path("new/sub")));
  EXPECT_TRUE(output::make_folder(path("new/sub")));
}

TEST_F(Output, FailedRenameLeavesNothing) {
  fs::create_directories(folder_ / "taken" / "x");
  auto file = output::AtomicFile::create(path("taken"));
  ASSERT_TRUE(file);
  file->write("text");
  const auto result = file->commit();
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().front().text().find("directory"), std::string::npos);
  EXPECT_EQ(file_count(), 1u);
}

// /dev/full takes no byte, like a full disk; a link stands in for the part.
TEST_F(Output, FullDiskIsReported) {
  ASSERT_TRUE(fs::exists("/dev/full"));
  fs::create_symlink("/dev/full", path("a.csv.part"));
  auto csv = output::BodiesCsv::create(path("a.csv"));
  ASSERT_TRUE(csv);
  const auto result = csv->commit();
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().front().text().find("No space left"), std::string::npos);
  EXPECT_EQ(file_count(), 0u);

  fs::create_symlink("/dev/full", path("a.ply.part"));
  const Surface s = grid(200, 200, 1);
  const auto ply = output::write_ply(path("a.ply"), view(s), std::vector<float>(s.position.size()));
  ASSERT_FALSE(ply);
  EXPECT_NE(ply.error().front().text().find("No space left"), std::string::npos);
  EXPECT_EQ(file_count(), 0u);
}

// --- PLY ---

template <class T>
T take(const std::string& bytes, std::size_t& at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  at += sizeof value;
  return value;
}

TEST_F(Output, PlyHoldsEveryVertexAndFace) {
  Surface s = grid(40, 35, 2.5, [](double x, double y) { return 0.1 * x - 0.2 * y; });
  s.origin = {4'000'000, 500'000, 1200};
  std::vector<float> sinkage(s.position.size());
  for (std::size_t v = 0; v < sinkage.size(); ++v) {
    sinkage[v] = static_cast<float>(v) * 0.01f;
    s.material[v] = static_cast<std::uint8_t>(v % 3);
  }
  ASSERT_TRUE(output::write_ply(path("s.ply"), view(s), sinkage));
  EXPECT_EQ(file_count(), 1u);

  const std::string bytes = slurp(path("s.ply"));
  std::size_t at = bytes.find("end_header\n") + 11;
  const std::string header = bytes.substr(0, at);
  EXPECT_EQ(header.rfind("ply\nformat binary_little_endian 1.0\n", 0), 0u);
  EXPECT_NE(header.find("element vertex 1400\nproperty double x"), std::string::npos);
  EXPECT_NE(header.find("element face 2652\nproperty list uchar uint vertex_indices"), std::string::npos);
  ASSERT_EQ(bytes.size(), at + 1400 * (3 * 8 + 4 + 1) + 2652 * 13);
  for (std::size_t v = 0; v < s.position.size(); ++v) {
    const Vec3d p = to_double(s.position[v]) + s.origin;
    EXPECT_EQ(take<double>(bytes, at), p.x);
    EXPECT_EQ(take<double>(bytes, at), p.y);
    EXPECT_EQ(take<double>(bytes, at), p.z);
    EXPECT_EQ(take<float>(bytes, at), sinkage[v]);
    EXPECT_EQ(take<std::uint8_t>(bytes, at), v % 3);
  }
  for (std::size_t k = 0; k < s.mesh.triangles().size(); ++k) {
    if (k % 3 == 0) {
      EXPECT_EQ(take<std::uint8_t>(bytes, at), 3);
    }
    EXPECT_EQ(take<std::uint32_t>(bytes, at), s.mesh.triangles()[k]);
  }
}

// --- rasters ---

TEST_F(Output, SurfaceAtRestKeepsItsHeights) {
  const Surface s = grid(50, 33, 3, [](double x, double y) { return std::sin(x) * std::cos(y); });
  const RasterView r = output::resample(s);
  ASSERT_EQ(r.columns, 50u);
  ASSERT_EQ(r.rows, 33u);
  EXPECT_EQ(r.x0, -73.5);
  EXPECT_EQ(r.y0, 48);
  for (std::uint32_t row = 0; row < 33; ++row)
    for (std::uint32_t column = 0; column < 50; ++column)
      EXPECT_EQ(r.heights[row * 50 + column], s.position[s.raster->layout.vertex(column, 32 - row)].z);
}

// Vertices pushed sideways on a plane: the plane stays where it is.
TEST_F(Output, SidewaysMotionDoesNotMoveTheGround) {
  Surface s = grid(60, 60, 1);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> push(-0.3f, 0.3f);
  for (Vec3& p : s.position) {
    if (std::abs(p.x) < 25 && std::abs(p.y) < 25) p += Vec3{push(random), push(random), 0};
    p.z = 5 + 0.3f * p.x - 0.2f * p.y;
  }
  const RasterView r = output::resample(s);
  for (std::uint32_t row = 0; row < r.rows; ++row)
    for (std::uint32_t column = 0; column < r.columns; ++column)
      EXPECT_NEAR(r.heights[row * 60 + column], 5 + 0.3 * (r.x0 + column * r.dx) - 0.2 * (r.y0 - row * r.dy), 1e-4);
}

// A whole patch moved by several cells: nodes are found by walking, and against a search through every triangle.
TEST_F(Output, NodesAreFoundAgainFarFromTheirVertex) {
  Surface s = grid(40, 40, 1, [](double x, double y) { return 0.3 * std::sin(0.5 * x) + 0.2 * std::cos(0.7 * y); });
  for (Vec3& p : s.position) {
    const float r2 = p.x * p.x + p.y * p.y;
    p += 3.0f * std::exp(-r2 / 40) * Vec3{1, 0.5f, 0};
  }
  const RasterView r = output::resample(s);
  const auto triangles = s.mesh.triangles();
  for (std::uint32_t row = 0; row < r.rows; row += 3) {
    for (std::uint32_t column = 0; column < r.columns; column += 3) {
      const double x = r.x0 + column * r.dx, y = r.y0 - row * r.dy;
      bool found = false;
      for (std::size_t k = 0; k < triangles.size() && !found; k += 3) {
        const auto p = [&](std::size_t j) { return to_double(s.position[triangles[k + j]]) - Vec3d{x, y, 0}; };
        const Vec3d a = p(0), b = p(1), c = p(2);
        const double wa = cross(b, c).z, wb = cross(c, a).z, wc = cross(a, b).z;
        if (wa < -1e-12 || wb < -1e-12 || wc < -1e-12) continue;
        found = true;
        EXPECT_NEAR(r.heights[row * 40 + column], (wa * a.z + wb * b.z + wc * c.z) / (wa + wb + wc), 1e-5);
      }
    }
  }
}

TEST_F(Output, GeotiffReadsBackInPlaceWithItsHoles) {
  RasterView r{.columns = 5,
               .rows = 3,
               .x0 = 500'005,
               .y0 = 4'000'025,
               .dx = 10,
               .dy = 20,
               .crs = {},
               .heights = {},
               .holes = {}};
  OGRSpatialReference utm;
  ASSERT_EQ(utm.SetFromUserInput("EPSG:32633"), OGRERR_NONE);
  char* wkt = nullptr;
  ASSERT_EQ(utm.exportToWkt(&wkt), OGRERR_NONE);
  r.crs = wkt;
  CPLFree(wkt);
  for (int k = 0; k < 15; ++k) r.heights.push_back(static_cast<float>(k) + 0.25f), r.holes.push_back(k == 7);
  const auto written = write_heights(path("t.tif"), r);
  ASSERT_TRUE(written) << written.error().front().text();
  EXPECT_EQ(file_count(), 1u);

  const GDALDatasetUniquePtr file(GDALDataset::Open(path("t.tif").c_str(), GDAL_OF_RASTER));
  ASSERT_TRUE(file);
  std::array<double, 6> t{};
  ASSERT_EQ(file->GetGeoTransform(t.data()), CE_None);
  EXPECT_EQ(t, (std::array<double, 6>{500'000, 10, 0, 4'000'035, 0, -20}));
  EXPECT_TRUE(file->GetSpatialRef()->IsSame(&utm));
  GDALRasterBand& band = *file->GetRasterBand(1);
  EXPECT_EQ(band.GetRasterDataType(), GDT_Float32);
  EXPECT_EQ(band.GetNoDataValue(), -9999);
  std::vector<float> value(15);
  ASSERT_EQ(band.RasterIO(GF_Read, 0, 0, 5, 3, value.data(), 5, 3, GDT_Float32, 0, 0, nullptr), CE_None);
  r.heights[7] = -9999;
  EXPECT_EQ(value, r.heights);
}

// GDAL would put what a TIFF has no words for into a file of its own beside it.
TEST_F(Output, GeotiffIsOneFileWhateverTheCoordinateSystem) {
  RasterView r = output::resample(grid(8, 8, 1));
  for (const char* crs : {"LOCAL_CS[\"yard\",UNIT[\"metre\",1]]", "+proj=oea +lat_1=1 +lon_1=2 +m=1 +n=1 +units=m",
                          "+proj=ortho +lat_0=40 +lon_0=10 +units=m"}) {
    OGRSpatialReference reference;
    ASSERT_EQ(reference.SetFromUserInput(crs), OGRERR_NONE) << crs;
    char* wkt = nullptr;
    reference.exportToWkt(&wkt);
    r.crs = wkt;
    CPLFree(wkt);
    const auto written = write_heights(path("t.tif"), r);
    EXPECT_TRUE(written) << written.error().front().text();
    EXPECT_EQ(file_count(), 1u) << crs;
  }
}

// Written and loaded again, every scene's terrain is the same ground at the same place.
TEST_F(Output, TerrainSurvivesARoundTrip) {
  for (const auto& [file, crs] : {std::pair{"volcano.asc", ""}, {"olinda_dem_utm25s.tif", ""}}) {
    Scene scene;
    scene.folder = std::string(test::source_dir()) + "/scenes/dem";
    scene.terrain.shape = DemTerrain{.path = file, .crs = crs, .band = 1};
    const auto before = terrain::load_terrain(scene);
    ASSERT_TRUE(before) << before.error().front().text();
    ASSERT_TRUE(write_heights(path("again.tif"), output::resample(*before)));
    EXPECT_EQ(file_count(), 1u) << file;
    scene.terrain.shape = DemTerrain{.path = path("again.tif"), .crs = {}, .band = 1};
    const auto after = terrain::load_terrain(scene);
    ASSERT_TRUE(after) << after.error().front().text();
    ASSERT_EQ(after->position.size(), before->position.size());
    EXPECT_EQ(std::vector<std::uint32_t>(after->mesh.triangles().begin(), after->mesh.triangles().end()),
              std::vector<std::uint32_t>(before->mesh.triangles().begin(), before->mesh.triangles().end()));
    EXPECT_NEAR(length(after->origin - before->origin), 0, 1e-6);
    for (std::size_t v = 0; v < after->position.size(); ++v) {
      if (before->mesh.outgoing(static_cast<std::uint32_t>(v)) == kNone) continue;
      EXPECT_NEAR(length(after->position[v] - before->position[v]), 0, 1e-3);
    }
  }
}

// A model in degrees comes back in degrees: as many pixels, give or take what was turned, with the same relief in the
// same place.
TEST_F(Output, AModelInDegreesIsWrittenInDegrees) {
  Scene scene;
  scene.folder = std::string(test::source_dir()) + "/scenes/dem";
  const DemTerrain model{.path = scene.folder + "/jacksboro.asc", .crs = "EPSG:4326", .band = 1};
  scene.terrain.shape = model;
  const auto surface = terrain::load_terrain(scene);
  ASSERT_TRUE(surface) << surface.error().front().text();
  const RasterView raster = output::resample(*surface);
  EXPECT_NE(raster.crs, raster.file_crs);
  ASSERT_TRUE(write_heights(path("again.tif"), raster));
  EXPECT_EQ(file_count(), 1u);
  const auto before = terrain::read_dem(model, 1'000'000);
  const auto after = terrain::read_dem({.path = path("again.tif"), .crs = {}, .band = 1}, 1'000'000);
  ASSERT_TRUE(before && after);
  EXPECT_TRUE(after->crs.IsGeographic());
  // The place of a pixel of one in pixels of the other.
  const auto &to = after->transform, &from = before->transform;
  double sum = 0, low = 1e9, high = -1e9;
  int count = 0;
  for (std::uint32_t row = 0; row < after->rows; ++row) {
    for (std::uint32_t column = 0; column < after->columns; ++column) {
      const float height = after->height[std::size_t{row} * after->columns + column];
      const double i = (to[0] + (column + 0.5) * to[1] - from[0]) / from[1] - 0.5;
      const double j = (to[3] + (row + 0.5) * to[5] - from[3]) / from[5] - 0.5;
      if (std::isnan(height) || i < 0 || j < 0 || i > before->columns - 2.0 || j > before->rows - 2.0) continue;
      const auto at = [&](double x, double y) {
        return static_cast<double>(
            before->height[static_cast<std::size_t>(y) * before->columns + static_cast<std::size_t>(x)]);
      };
      const double x = i - std::floor(i), y = j - std::floor(j);
      const double was =
          (1 - y) * ((1 - x) * at(i, j) + x * at(i + 1, j)) + y * ((1 - x) * at(i, j + 1) + x * at(i + 1, j + 1));
      sum += std::abs(height - was), low = std::min(low, was), high = std::max(high, was), ++count;
    }
  }
  EXPECT_GT(count, 0.9 * before->columns * before->rows);
  EXPECT_LT(count, 1.1 * before->columns * before->rows);
  EXPECT_LT(sum / count, 0.003 * (high - low)) << "what bilinear and cubic surfaces differ by";
}

TEST_F(Output, GeotiffThatCannotBeWrittenLeavesNothing) {
  const RasterView r = output::resample(grid(40, 40, 1));
  EXPECT_NE(write_heights(path("no/such/t.tif"), r).error().front().text().find("No such file"), std::string::npos);
  if (fs::exists("/dev/full")) {
    fs::create_symlink("/dev/full", path("t.tif.part"));
    ::testing::internal::CaptureStderr();
    const auto full = write_heights(path("t.tif"), r);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    ASSERT_FALSE(full);
  }
  EXPECT_EQ(file_count(), 0u);
}

// --- text ---

TEST_F(Output, CsvNumbersReadBackToTheBit) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-1e6, 1e6);
  std::vector<BodyView> bodies(2);
  bodies[0].name = "ball";
  bodies[1].name = "truck, \"big\"";
  for (BodyView& b : bodies) {
    b.position = {any(random), any(random), 1e-300};
    b.velocity = {any(random), -0.0, 1.0 / 3};
    b.sinkage = any(random);
  }
  auto csv = output::BodiesCsv::create(path("bodies.csv"));
  ASSERT_TRUE(csv);
  csv->append(0.1, bodies);
  EXPECT_FALSE(fs::exists(path("bodies.csv")));
  ASSERT_TRUE(csv->commit());

  std::istringstream in(slurp(path("bodies.csv")));
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "time,name,x,y,z,vx,vy,vz,qx,qy,qz,qw,sinkage");
  std::getline(in, line);
  EXPECT_EQ(line.rfind("0.1,ball,", 0), 0u);
  std::vector<double> numbers;
  std::istringstream cells(line.substr(9));
  for (std::string cell; std::getline(cells, cell, ',');) numbers.push_back(std::strtod(cell.c_str(), nullptr));
  const BodyView& b = bodies[0];
  EXPECT_EQ(numbers, (std::vector<double>{b.position.x, b.position.y, b.position.z, b.velocity.x, b.velocity.y,
                                          b.velocity.z, 0, 0, 0, 1, b.sinkage}));
  std::getline(in, line);
  EXPECT_EQ(line.rfind("0.1,\"truck, \"\"big\"\"\",", 0), 0u);
}

TEST_F(Output, HeadingIsTheAngleSeenFromAbove) {
  EXPECT_NEAR(output::heading_change_deg({25, 0, 3}, {0, 5, -9}), 90, 1e-12);
  EXPECT_NEAR(output::heading_change_deg({25, 0, 0}, {5, -5, 0}), 45, 1e-12);
  EXPECT_NEAR(output::heading_change_deg({1, 0, 0}, {-1, 0, 0}), 180, 1e-12);
  EXPECT_EQ(output::heading_change_deg({0, 0, -4}, {-1, 2, 0}), 0);
  EXPECT_EQ(output::heading_change_deg({-3, 1, 0}, {0, 0, 0}), 0);
  EXPECT_EQ(output::heading_change_deg({0, 0, 0}, {-3, -1, 0}), 0) << "what started at rest";
  EXPECT_EQ(output::heading_change_deg({3, 0, 0}, {-0.0005, 0, 0}), 0) << "what has come to rest";
  EXPECT_EQ(output::heading_change_deg({-3, 1, 0}, {-0.0, -0.0, 1}), 0);
}

TEST_F(Output, JsonKeepsItsOrderAndRefusesWhatIsNoNumber) {
  nlohmann::ordered_json json = {{"z", 1}, {"a", {1.5, 2.5}}, {"name", "r\xff"}};
  ASSERT_TRUE(output::write_json(path("s.json"), json));
  const std::string text = slurp(path("s.json"));
  EXPECT_LT(text.find("\"z\""), text.find("\"a\""));
  EXPECT_TRUE(nlohmann::json::accept(text));

  json["bodies"] = {{{"velocity", {1.0, std::numeric_limits<double>::infinity()}}}};
  const auto bad = output::write_json(path("t.json"), json);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().front().key, "bodies.0.velocity.1");
  EXPECT_EQ(file_count(), 1u);
}

}  // namespace
}  // namespace divot
