#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <stdexcept>

#include "core/gdal.h"
#include "source_dir.h"
#include "terrain/height_field.h"
#include "terrain/lattice.h"
#include "terrain/terrain.h"

namespace divot {
namespace {

namespace fs = std::filesystem;
using state::GridLayout;
using state::Surface;

// A folder of its own for each test, gone when the test is over.
class Terrain : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) /
              (std::string("divot_terrain_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

Scene grid_scene(int columns, int rows, double spacing) {
  Scene scene;
  scene.terrain.shape = GridTerrain{.columns = columns, .rows = rows, .spacing = spacing, .height = {}};
  return scene;
}

Scene dem_scene(const std::string& path, const std::string& crs = {}, int band = 1) {
  Scene scene;
  scene.folder = std::string(test::source_dir()) + "/scenes";
  scene.terrain.shape = DemTerrain{.path = path, .crs = crs, .band = band};
  return scene;
}

Surface load(const Scene& scene) {
  auto surface = terrain::load_terrain(scene);
  if (!surface) {
    ADD_FAILURE() << surface.error().front().text();
    return {};
  }
  EXPECT_EQ(surface->mesh.validate(), "");
  EXPECT_EQ(surface->mesh.vertex_count(), surface->position.size());
  EXPECT_EQ(surface->material.size(), surface->position.size());
  EXPECT_EQ(surface->column.size(), surface->position.size());
  for (const Vec3& p : surface->position) EXPECT_TRUE(is_finite(p));
  return std::move(*surface);
}

Error load_error(const Scene& scene) {
  auto surface = terrain::load_terrain(scene);
  if (surface) {
    ADD_FAILURE() << "loaded";
    return {};
  }
  return surface.error().front();
}

double height(const Surface& s, std::uint32_t vertex) { return s.position[vertex].z + s.origin.z; }

std::uint32_t hole_count(const Surface& s) {
  std::uint32_t count = 0;
  for (std::uint32_t v = 0; v < s.mesh.vertex_count(); ++v) count += s.mesh.outgoing(v) == kNone;
  return count;
}

// What GDAL says a file holds, one row after the other from the north.
struct Pixels {
  int columns = 0, rows = 0;
  std::vector<float> value;
};

Pixels read(const std::string& path) {
  const core::GdalSession session;
  const GDALDatasetUniquePtr file(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER));
  Pixels out{file->GetRasterXSize(), file->GetRasterYSize(), {}};
  out.value.resize(static_cast<std::size_t>(out.columns) * out.rows);
  EXPECT_EQ(file->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, out.columns, out.rows, out.value.data(), out.columns,
                                             out.rows, GDT_Float32, 0, 0, nullptr),
            CE_None);
  return out;
}

// What a GeoTIFF made by a test holds besides its heights.
struct Made {
  std::array<double, 6> transform{1000, 10, 0, 2000, 0, -10};
  std::string crs = "EPSG:32633";
  double nodata = std::numeric_limits<double>::quiet_NaN();  // NaN: none
  std::string unit = "";
  double scale = 1, offset = 0;
};

void make_tiff(const std::string& path, int columns, int rows, std::vector<float> value, const Made& made) {
  const core::GdalSession session;
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  const GDALDatasetUniquePtr file(driver->Create(path.c_str(), columns, rows, 1, GDT_Float32, nullptr));
  ASSERT_TRUE(file);
  auto transform = made.transform;
  file->SetGeoTransform(transform.data());
  OGRSpatialReference crs;
  if (!made.crs.empty()) {
    ASSERT_EQ(crs.SetFromUserInput(made.crs.c_str()), OGRERR_NONE);
    file->SetSpatialRef(&crs);
  }
  GDALRasterBand& band = *file->GetRasterBand(1);
  if (!std::isnan(made.nodata)) band.SetNoDataValue(made.nodata);
  if (!made.unit.empty()) band.SetUnitType(made.unit.c_str());
  if (made.scale != 1) band.SetScale(made.scale);
  if (made.offset != 0) band.SetOffset(made.offset);
  ASSERT_EQ(band.RasterIO(GF_Write, 0, 0, columns, rows, value.data(), columns, rows, GDT_Float32, 0, 0, nullptr),
            CE_None);
}

// --- the lattice ---

TEST(GridLayout, NumbersEveryVertexOnceAndTilesTogether) {
  for (const auto& [columns, rows] : {std::pair{37u, 40u}, {64u, 32u}, {2u, 2u}, {33u, 97u}, {100u, 1u}}) {
    const GridLayout layout{columns, rows};
    std::vector<int> seen(static_cast<std::size_t>(columns) * rows);
    for (std::uint32_t r = 0; r < rows; ++r)
      for (std::uint32_t c = 0; c < columns; ++c) ++seen.at(layout.vertex(c, r));
    EXPECT_EQ(std::set<int>(seen.begin(), seen.end()), std::set<int>{1});
  }
  const GridLayout layout{100, 100};
  for (std::uint32_t r = 0; r < 32; ++r)
    for (std::uint32_t c = 0; c < 32; ++c) EXPECT_LT(layout.vertex(c, r), 1024u);
}

TEST_F(Terrain, PaperGridHasItsTrianglesAndPlaces) {
  const Surface s = load(grid_scene(37, 40, 10.9));
  EXPECT_EQ(s.mesh.face_count(), 2808u);
  EXPECT_EQ(s.mesh.vertex_count(), 37u * 40u);
  EXPECT_EQ(s.origin, Vec3d{});
  EXPECT_FLOAT_EQ(s.spacing, 10.9f);
  for (std::uint32_t row = 0; row < 40; ++row) {
    for (std::uint32_t column = 0; column < 37; ++column) {
      const Vec3& p = s.position[s.raster->layout.vertex(column, row)];
      EXPECT_NEAR(p.x, (column - 18.0) * 10.9, 1e-4);
      EXPECT_NEAR(p.y, (row - 19.5) * 10.9, 1e-4);
      EXPECT_EQ(p.z, 0);
    }
  }
  EXPECT_EQ(hole_count(s), 0u);
  EXPECT_EQ(std::set<std::uint8_t>(s.material.begin(), s.material.end()), std::set<std::uint8_t>{0});
  EXPECT_EQ(std::set<std::uint32_t>(s.column.begin(), s.column.end()), std::set<std::uint32_t>{kNone});
}

TEST_F(Terrain, TrianglesCoverTheGridOnceFacingUp) {
  const Surface s = load(grid_scene(70, 45, 2));
  double area = 0;
  for (std::size_t k = 0; k < s.mesh.triangles().size(); k += 3) {
    const auto p = [&](std::size_t j) { return s.position[s.mesh.triangles()[k + j]]; };
    const float twice = cross(p(1) - p(0), p(2) - p(0)).z;
    EXPECT_FLOAT_EQ(twice, 4);
    area += twice / 2;
  }
  EXPECT_NEAR(area, 69 * 44 * 4, 1e-3);
}

// Mirrored in x, y or both, the triangles are the same set when the number of cells is even.
TEST_F(Terrain, DiagonalsAreSymmetric) {
  const GridLayout layout{37, 41};
  const std::vector<std::uint8_t> none(37 * 41, 0);
  const auto edges = [&](bool flip_x, bool flip_y) {
    std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> place;
    for (std::uint32_t r = 0; r < 41; ++r)
      for (std::uint32_t c = 0; c < 37; ++c) place[layout.vertex(c, r)] = {flip_x ? 36 - c : c, flip_y ? 40 - r : r};
    std::set<std::set<std::pair<std::uint32_t, std::uint32_t>>> out;
    const auto triangles = terrain::triangulate(layout, none);
    for (std::size_t k = 0; k < triangles.size(); k += 3)
      out.insert({place[triangles[k]], place[triangles[k + 1]], place[triangles[k + 2]]});
    return out;
  };
  EXPECT_EQ(edges(true, true), edges(false, false));
  EXPECT_EQ(edges(true, false), edges(false, false));
  EXPECT_EQ(edges(false, true), edges(false, false));
}

// Random holes of every density: the mesh accepts what is left, and keeps every triangle that it can.
TEST_F(Terrain, RandomHolesLeaveAWalkableSurface) {
  std::mt19937 random(7);
  std::uniform_int_distribution<std::uint32_t> size(2, 60);
  for (const double density : {0.01, 0.1, 0.3, 0.5, 0.8}) {
    for (int round = 0; round < 20; ++round) {
      const GridLayout layout{size(random), size(random)};
      std::vector<std::uint8_t> holes(static_cast<std::size_t>(layout.columns) * layout.rows);
      for (auto& hole : holes) hole = std::bernoulli_distribution(density)(random);
      const auto given = holes;
      terrain::close_pinches(layout, holes);
      const auto triangles = terrain::triangulate(layout, holes);
      const auto mesh = geometry::HalfEdgeMesh::build(static_cast<std::uint32_t>(holes.size()), triangles);
      ASSERT_TRUE(mesh) << mesh.error().front().text();
      EXPECT_EQ(mesh->validate(), "");
      for (const std::uint32_t v : triangles) EXPECT_EQ(given[v], 0);
    }
  }
}

// A grid's mesh stores nothing of what its numbering says: it must be that of its triangles, edited or not.
TEST_F(Terrain, GridsMeshIsThatOfItsTriangles) {
  std::mt19937 random(11);
  for (int round = 0; round < 60; ++round) {
    const GridLayout layout{2 + static_cast<std::uint32_t>(random() % 80),
                            2 + static_cast<std::uint32_t>(random() % 80)};
    const auto count = layout.columns * layout.rows;
    const auto triangles = terrain::triangulate(layout, std::vector<std::uint8_t>(count));
    auto implied = geometry::HalfEdgeMesh::of_grid(layout, triangles);
    auto stored = *geometry::HalfEdgeMesh::build(count, triangles);
    const auto fan_of = [](const geometry::HalfEdgeMesh& mesh, std::uint32_t v) {
      std::vector<std::uint32_t> fan;
      mesh.for_each_outgoing(v, [&](std::uint32_t h) { fan.push_back(h); });
      return fan;
    };
    const auto expect_same = [&] {
      ASSERT_EQ(implied.half_edge_count(), stored.half_edge_count());
      ASSERT_EQ(implied.vertex_count(), stored.vertex_count());
      for (std::uint32_t h = 0; h < stored.half_edge_count(); ++h) {
        ASSERT_EQ(implied.origin(h), stored.origin(h)) << h;
        ASSERT_EQ(implied.twin(h), stored.twin(h)) << h;
      }
      for (std::uint32_t v = 0; v < stored.vertex_count(); ++v) {
        ASSERT_EQ(implied.outgoing(v), stored.outgoing(v)) << v;
        ASSERT_EQ(fan_of(implied, v), fan_of(stored, v)) << v;
      }
    };
    expect_same();
    for (int edit = 0; edit < 30; ++edit) {
      const auto h = static_cast<std::uint32_t>(random() % stored.half_edge_count());
      switch (random() % 3) {
        case 0:
          ASSERT_EQ(implied.flip_edge(h), stored.flip_edge(h));
          break;
        case 1:
          ASSERT_EQ(implied.collapse_edge(h), stored.collapse_edge(h));
          break;
        default: {
          ASSERT_EQ(implied.split_edge(h), stored.split_edge(h));
          if (random() % 2 == 0) implied.unsplit_edge(h), stored.unsplit_edge(h);
        }
      }
    }
    expect_same();
    if (HasFatalFailure()) return;
  }
}

TEST_F(Terrain, OneHoleTakesFourCellsDownToATriangleEach) {
  const GridLayout layout{5, 5};
  std::vector<std::uint8_t> holes(25);
  holes[layout.vertex(2, 2)] = 1;
  terrain::close_pinches(layout, holes);
  EXPECT_EQ(terrain::triangulate(layout, holes).size(), 3u * (2 * 16 - 4));
  // Two holes facing each other over a vertex: that vertex would hold two fans, so it goes too.
  holes[layout.vertex(2, 4)] = 1;
  terrain::close_pinches(layout, holes);
  EXPECT_EQ(holes[layout.vertex(2, 3)], 1);
}

// --- grids ---

TEST_F(Terrain, GridFollowsItsHeightFunction) {
  Scene scene = grid_scene(50, 34, 0.5);
  std::get<GridTerrain>(scene.terrain.shape).height = [](double x, double y) { return std::sin(x) + 0.1 * y; };
  const Surface s = load(scene);
  for (const Vec3& p : s.position) EXPECT_NEAR(p.z, std::sin(p.x) + 0.1 * p.y, 1e-5);
}

TEST_F(Terrain, RefusesBadGrids) {
  EXPECT_EQ(load_error(grid_scene(1, 40, 1)).key, "terrain.grid");
  EXPECT_EQ(load_error(grid_scene(-5, 40, 1)).key, "terrain.grid");
  EXPECT_EQ(load_error(grid_scene(4, 4, 0)).key, "terrain.grid.spacing");
  Scene scene = grid_scene(4, 4, 1);
  auto& grid = std::get<GridTerrain>(scene.terrain.shape);
  for (const double bad : {std::nan(""), 1e300, -HUGE_VAL}) {
    grid.height = [=](double x, double) { return x > 0 ? bad : 0; };
    EXPECT_NE(load_error(scene).problem.find("not finite"), std::string::npos);
  }
  grid.height = [](double, double) -> double { throw std::runtime_error("no such hill"); };
  EXPECT_NE(load_error(scene).problem.find("no such hill"), std::string::npos);
}

TEST_F(Terrain, RefusesABillionVerticesAtOnce) {
  const auto start = std::chrono::steady_clock::now();
  const Error error = load_error(grid_scene(40'000, 25'000, 1));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(100));
  EXPECT_NE(error.problem.find("1000000000"), std::string::npos);
  EXPECT_NE(error.problem.find("20000000"), std::string::npos);
  EXPECT_NE(error.problem.find("GB"), std::string::npos);

  Scene boundless = grid_scene(2'000'000'000, 2'000'000'000, 1);
  boundless.terrain.max_vertices = std::numeric_limits<std::uint64_t>::max();
  EXPECT_NE(load_error(boundless).expected.find("numbered"), std::string::npos);

  Scene dem = dem_scene("dem/volcano.asc");
  dem.terrain.max_vertices = 5000;
  EXPECT_NE(load_error(dem).problem.find("87 x 61 = 5307"), std::string::npos);
}

// --- elevation models ---

// Every pixel at its place: heights as GDAL reads them, coordinates from the file's header.
void expect_pixels(const Surface& s, const Pixels& pixels, double west, double north, double dx, double dy) {
  const GridLayout& layout = s.raster->layout;
  ASSERT_EQ(static_cast<int>(layout.columns), pixels.columns);
  ASSERT_EQ(static_cast<int>(layout.rows), pixels.rows);
  for (int j = 0; j < pixels.rows; ++j) {
    for (int i = 0; i < pixels.columns; ++i) {
      const std::uint32_t v =
          layout.vertex(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(pixels.rows - 1 - j));
      const Vec3d p = to_double(s.position[v]) + s.origin;
      ASSERT_NEAR(p.x, west + (i + 0.5) * dx, 1e-3);
      ASSERT_NEAR(p.y, north - (j + 0.5) * dy, 1e-3);
      ASSERT_NEAR(p.z, pixels.value[static_cast<std::size_t>(j) * pixels.columns + i], 1e-4);
    }
  }
}

TEST_F(Terrain, VolcanoIsTakenAsMetres) {
  const Surface s = load(dem_scene("dem/volcano.asc"));
  expect_pixels(s, read(std::string(test::source_dir()) + "/scenes/dem/volcano.asc"), 0, 610, 10, 10);
  EXPECT_FLOAT_EQ(s.spacing, 10);
  EXPECT_EQ(s.raster->crs, "");
  EXPECT_EQ(s.origin.z, std::round(s.origin.z));
  EXPECT_EQ(s.mesh.face_count(), 2u * 86 * 60);
}

TEST_F(Terrain, OlindaKeepsItsUtmCoordinates) {
  const Surface s = load(dem_scene("dem/olinda_dem_utm25s.tif"));
  const std::string file = std::string(test::source_dir()) + "/scenes/dem/olinda_dem_utm25s.tif";
  std::array<double, 6> t{};
  {
    const core::GdalSession session;
    const GDALDatasetUniquePtr dataset(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER));
    ASSERT_EQ(dataset->GetGeoTransform(t.data()), CE_None);
  }
  expect_pixels(s, read(file), t[0], t[3], t[1], -t[5]);
  EXPECT_NEAR(s.spacing, 89.99, 0.01);
  EXPECT_NE(s.raster->crs.find("UTM"), std::string::npos);
  EXPECT_GT(s.origin.y, 9e6);
}

TEST_F(Terrain, DegreesAreNeverTakenForMetres) {
  const Error error = load_error(dem_scene("dem/jacksboro.asc"));
  EXPECT_EQ(error.key, "terrain.crs");
  EXPECT_NE(error.problem.find("degrees"), std::string::npos);
  EXPECT_NE(error.expected.find("crs = \"EPSG:4326\""), std::string::npos);
}

TEST_F(Terrain, JacksboroInDegreesBecomesMetres) {
  const Surface s = load(dem_scene("dem/jacksboro.asc", "EPSG:4326"));
  EXPECT_NEAR(s.spacing, 84, 5);
  EXPECT_EQ(s.raster->dx, s.raster->dy);
  double low = 1e9, high = -1e9;
  for (std::uint32_t v = 0; v < s.mesh.vertex_count(); ++v) {
    low = std::min(low, height(s, v));
    high = std::max(high, height(s, v));
  }
  EXPECT_NEAR(low, 236, 5);
  EXPECT_NEAR(high, 1076, 2);
  EXPECT_LT(hole_count(s), s.mesh.vertex_count() / 50);
  EXPECT_NEAR(s.origin.x, 0, 200);
  EXPECT_NEAR(s.origin.y, 0, 200);

  // 344 rows of 3 arc-seconds are 31.8 km, 403 columns at 36.6 degrees north 30.0 km.
  EXPECT_NEAR(s.raster->layout.rows * s.raster->dy, 31'800, 500);
  EXPECT_NEAR(s.raster->layout.columns * s.raster->dx, 30'000, 500);

  // The pixel in the middle of the file is in the middle of the terrain.
  const Pixels pixels = read(std::string(test::source_dir()) + "/scenes/dem/jacksboro.asc");
  const auto column = static_cast<std::uint32_t>(std::lround(-s.raster->x0 / s.raster->dx));
  const auto row = static_cast<std::uint32_t>(std::lround(-s.raster->y0 / s.raster->dy));
  EXPECT_NEAR(height(s, s.raster->layout.vertex(column, row)), pixels.value[172 * 403 + 201], 25);
}

TEST_F(Terrain, ProjectedSystemThatIsNoneIsRefused) {
  const Error error = load_error(dem_scene("dem/volcano.asc", "EPSG:nonsense"));
  EXPECT_EQ(error.key, "terrain.crs");
  EXPECT_EQ(load_error(dem_scene("dem/volcano.asc", "EPSG:4978")).key, "terrain.crs");  // geocentric
  EXPECT_EQ(load_error(dem_scene("dem/volcano.asc", "EPSG:4326")).key, "terrain.crs");  // 610 degrees north
}

TEST_F(Terrain, NodataAndNanAreHoles) {
  std::vector<float> value(30 * 20, 100);
  value[5 * 30 + 7] = -9999;
  value[10 * 30 + 20] = std::numeric_limits<float>::quiet_NaN();
  value[15 * 30 + 3] = std::numeric_limits<float>::infinity();
  make_tiff(path("holes.tif"), 30, 20, value, {.nodata = -9999});
  const Surface s = load(dem_scene(path("holes.tif")));
  EXPECT_EQ(hole_count(s), 3u);
  for (const auto& [column, row] : {std::pair{7u, 14u}, {20u, 9u}, {3u, 4u}}) {
    const std::uint32_t v = s.raster->layout.vertex(column, row);
    EXPECT_EQ(s.mesh.outgoing(v), kNone);
    EXPECT_EQ(height(s, v), 100);
  }
}

TEST_F(Terrain, HolesSurviveReprojection) {
  std::vector<float> value(60 * 60, 100);
  for (int j = 20; j < 30; ++j)
    for (int i = 20; i < 30; ++i) value[static_cast<std::size_t>(j) * 60 + i] = -32768;
  make_tiff(path("degrees.tif"), 60, 60, value,
            {.transform = {10, 0.001, 0, 50, 0, -0.001}, .crs = "EPSG:4326", .nodata = -32768});
  const Surface s = load(dem_scene(path("degrees.tif")));
  const double share = hole_count(s) / static_cast<double>(s.mesh.vertex_count());
  EXPECT_NEAR(share, 100.0 / 3600, 0.01);
  for (std::uint32_t v = 0; v < s.mesh.vertex_count(); ++v) EXPECT_NEAR(height(s, v), 100, 1e-3);
}

TEST_F(Terrain, AllNodataIsRefused) {
  make_tiff(path("empty.tif"), 8, 8, std::vector<float>(64, -1), {.nodata = -1});
  EXPECT_NE(load_error(dem_scene(path("empty.tif"))).problem.find("height"), std::string::npos);
  make_tiff(path("empty_degrees.tif"), 8, 8, std::vector<float>(64, -1),
            {.transform = {10, 0.001, 0, 50, 0, -0.001}, .crs = "EPSG:4326", .nodata = -1});
  EXPECT_NE(load_error(dem_scene(path("empty_degrees.tif"))).problem.find("height"), std::string::npos);
}

TEST_F(Terrain, UndeclaredNodataIsRefused) {
  std::vector<float> value(64, 5);
  value[9] = -std::numeric_limits<float>::max();
  make_tiff(path("wild.tif"), 8, 8, value, {});
  EXPECT_NE(load_error(dem_scene(path("wild.tif"))).expected.find("nodata"), std::string::npos);
}

TEST_F(Terrain, FeetBecomeMetres) {
  make_tiff(path("feet.tif"), 8, 8, std::vector<float>(64, 1000),
            {.transform = {5000, 10, 0, 3000, 0, -10}, .crs = "EPSG:2227", .unit = "US survey foot"});
  const Surface s = load(dem_scene(path("feet.tif")));
  EXPECT_NEAR(s.spacing, 10 * 1200.0 / 3937, 1e-5);
  EXPECT_NEAR(s.raster->x0, 5005 * 1200.0 / 3937, 1e-6);
  EXPECT_NEAR(height(s, 0), 1000 * 1200.0 / 3937, 1e-4);
  // The coordinate system goes with the coordinates.
  OGRSpatialReference crs;
  ASSERT_EQ(crs.importFromWkt(s.raster->crs.c_str()), OGRERR_NONE);
  EXPECT_EQ(crs.GetLinearUnits(), 1.0);

  make_tiff(path("fathoms.tif"), 8, 8, std::vector<float>(64, 1000), {.unit = "fathom"});
  EXPECT_NE(load_error(dem_scene(path("fathoms.tif"))).problem.find("fathom"), std::string::npos);
}

TEST_F(Terrain, ScaleAndOffsetAreApplied) {
  make_tiff(path("scaled.tif"), 8, 8, std::vector<float>(64, 200), {.scale = 0.5, .offset = 30});
  EXPECT_NEAR(height(load(dem_scene(path("scaled.tif"))), 0), 130, 1e-4);
}

TEST_F(Terrain, RastersThatRunTheOtherWayAreTurnedRound) {
  std::vector<float> value(6 * 4);
  for (std::size_t k = 0; k < value.size(); ++k) value[k] = static_cast<float>(k);
  make_tiff(path("south_first.tif"), 6, 4, value, {.transform = {100, -10, 0, 0, 0, 10}});
  const Surface s = load(dem_scene(path("south_first.tif")));
  EXPECT_EQ(s.raster->x0, 45);
  EXPECT_EQ(s.raster->y0, 5);
  EXPECT_EQ(height(s, s.raster->layout.vertex(0, 0)), 5);
  EXPECT_EQ(height(s, s.raster->layout.vertex(5, 3)), 18);
}

// A plane, turned by 20 degrees and laid out north-up again, is the same plane.
TEST_F(Terrain, RotatedRastersAreResampled) {
  constexpr int kSize = 60;
  const double c = 10 * std::cos(0.35), s = 10 * std::sin(0.35);
  const std::array<double, 6> t{500'000, c, s, 5'000'000, s, -c};
  const auto plane = [](double x, double y) { return 200 + 0.1 * (x - 500'000) - 0.05 * (y - 5'000'000); };
  std::vector<float> value;
  for (int j = 0; j < kSize; ++j)
    for (int i = 0; i < kSize; ++i)
      value.push_back(static_cast<float>(
          plane(t[0] + (i + 0.5) * t[1] + (j + 0.5) * t[2], t[3] + (i + 0.5) * t[4] + (j + 0.5) * t[5])));
  make_tiff(path("rotated.tif"), kSize, kSize, value, {.transform = t});
  const Surface surface = load(dem_scene(path("rotated.tif")));
  EXPECT_NEAR(surface.spacing, 10, 0.5);
  std::size_t compared = 0;
  for (std::uint32_t v = 0; v < surface.mesh.vertex_count(); ++v) {
    if (surface.mesh.outgoing(v) == kNone || surface.mesh.is_boundary(v)) continue;
    const Vec3d p = to_double(surface.position[v]) + surface.origin;
    EXPECT_NEAR(p.z, plane(p.x, p.y), 0.6);  // half a pixel inside the border, bilinear has no more neighbours
    ++compared;
  }
  EXPECT_GT(compared, 2500u);
}

TEST_F(Terrain, RefusesWhatIsNoRaster) {
  EXPECT_NE(load_error(dem_scene("dem/nowhere.tif")).problem.find("does not exist"), std::string::npos);
  std::ofstream(path("text.tif")) << "This is not a picture of a mountain.\n";
  const Error text = load_error(dem_scene(path("text.tif")));
  EXPECT_NE(text.problem.find("not a raster"), std::string::npos);
  EXPECT_EQ(text.file, path("text.tif"));
  EXPECT_EQ(load_error(dem_scene(path(""))).key, "terrain.dem");
  EXPECT_EQ(load_error(dem_scene("dem/volcano.asc", "", 2)).key, "terrain.band");
  EXPECT_EQ(load_error(dem_scene("dem/volcano.asc", "", 0)).key, "terrain.band");
}

TEST_F(Terrain, FilesCutShortAreRefused) {
  for (const std::string name : {"olinda_dem_utm25s.tif", "volcano.asc"}) {
    const fs::path whole = fs::path(test::source_dir()) / "scenes/dem" / name;
    const auto size = fs::file_size(whole);
    for (const double share : {0.0, 0.001, 0.1, 0.5, 0.9, 0.99}) {
      fs::copy_file(whole, path(name), fs::copy_options::overwrite_existing);
      fs::resize_file(path(name), static_cast<std::uintmax_t>(static_cast<double>(size) * share));
      EXPECT_EQ(load_error(dem_scene(path(name))).file, path(name)) << share;
    }
  }
}

TEST_F(Terrain, UngeoreferencedPicturesAreRefused) {
  const core::GdalSession session;
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  GDALDatasetUniquePtr(driver->Create(path("plain.tif").c_str(), 8, 8, 1, GDT_Byte, nullptr)).reset();
  EXPECT_NE(load_error(dem_scene(path("plain.tif"))).expected.find("georeferenced"), std::string::npos);
}

TEST_F(Terrain, GdalPrintsNothing) {
  std::ofstream(path("text.tif")) << "II*";
  ::testing::internal::CaptureStderr();
  EXPECT_FALSE(terrain::load_terrain(dem_scene(path("text.tif"))));
  EXPECT_FALSE(terrain::load_terrain(dem_scene("dem/volcano.asc", "EPSG:99999999")));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace divot
