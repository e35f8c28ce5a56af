// Ground from a triangle mesh in memory: what is refused and how, and that it behaves as a grid's ground does.
#include <algorithm>
#include <filesystem>
#include <limits>

#include "divot/output.h"
#include "support.h"
#include "terrain/mesh.h"

namespace divot {
namespace {

using test::make_world;
using test::run_to;

constexpr Vec3d kFar = {700000, 4000000, 120};  // as a DEM's coordinates are

// A patch of `columns` x `rows` vertices around `center`, with diagonals that all run one way.
MeshTerrain patch(std::uint32_t columns, std::uint32_t rows, double spacing, const Vec3d& center = kFar,
                  double wave = 0) {
  MeshTerrain mesh;
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const double x = (column - (columns - 1) / 2.0) * spacing, y = (row - (rows - 1) / 2.0) * spacing;
      mesh.vertices.push_back(center + Vec3d{x, y, wave * std::sin(0.1 * x) * std::cos(0.07 * y)});
    }
  }
  for (std::uint32_t row = 0; row + 1 < rows; ++row) {
    for (std::uint32_t column = 0; column + 1 < columns; ++column) {
      const std::uint32_t a = row * columns + column, b = a + 1, c = a + columns, d = c + 1;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, d, a, d, c});
    }
  }
  return mesh;
}

std::string refusal(const MeshTerrain& mesh, std::uint64_t max_vertices = 1000) {
  const auto surface = terrain::load_mesh(mesh, max_vertices);
  if (surface) return "accepted";
  EXPECT_EQ(surface.error().size(), 1u);
  return surface.error().front().text();
}

Scene scene_on(MeshTerrain mesh, const std::string& material) {
  Scene scene;
  scene.terrain = {.shape = std::move(mesh), .material = material};
  return scene;
}

TEST(MeshTerrain, LiesAroundTheCentreOfItsBox) {
  MeshTerrain mesh = patch(3, 2, 10);
  mesh.vertices[4].z += 8;
  mesh.vertices.push_back({0, 0, 0});  // no triangle has it
  const auto surface = terrain::load_mesh(mesh, 1000);
  ASSERT_TRUE(surface) << refusal(mesh);
  EXPECT_EQ(surface->origin, (kFar + Vec3d{0, 0, 4}));
  EXPECT_EQ(surface->position[0], (Vec3{-10, -5, -4}));
  EXPECT_EQ(surface->position[4], (Vec3{0, 5, 4}));
  EXPECT_EQ(surface->position[6], Vec3{});
  EXPECT_EQ(surface->mesh.validate(), "");
  EXPECT_FALSE(surface->raster.has_value());
  EXPECT_FLOAT_EQ(surface->spacing, static_cast<float>((7 * 10 + 2 * std::sqrt(200.0)) / 9));
  EXPECT_EQ(surface->column, std::vector<std::uint32_t>(7, kNone));
}

TEST(MeshTerrain, RefusesWhatIsNoSurface) {
  EXPECT_NE(refusal({}).find("terrain.mesh: the mesh has no triangles"), std::string::npos) << refusal({});
  EXPECT_NE(refusal(patch(9, 9, 1), 80).find("81 vertices are more than the limit of 80"), std::string::npos);

  MeshTerrain nan = patch(3, 3, 1, {});
  nan.vertices[5].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(nan).find("vertex 5 at (1, nan, 0) is not finite"), std::string::npos) << refusal(nan);

  MeshTerrain range = patch(3, 3, 1);
  range.triangles[7] = 9;
  EXPECT_NE(refusal(range).find("triangle 2 (1, 9, 5) names a vertex that does not exist"), std::string::npos)
      << refusal(range);

  MeshTerrain turned = patch(3, 3, 1);
  std::swap(turned.triangles[4], turned.triangles[5]);
  EXPECT_NE(refusal(turned).find("same direction"), std::string::npos) << refusal(turned);

  MeshTerrain third = patch(3, 3, 1);
  third.vertices.push_back(kFar + Vec3d{0, 0, 5});
  third.triangles.insert(third.triangles.end(), {0, 4, 9});
  EXPECT_NE(
      refusal(third).find("edge 0-4, from (699999, 3999999, 120) to (700000, 4000000, 120), belongs to 3 triangles"),
      std::string::npos)
      << refusal(third);
}

TEST(MeshTerrain, RefusesWhatIsNoGround) {
  MeshTerrain down = patch(3, 3, 1);
  for (std::size_t i = 0; i < down.triangles.size(); i += 3) std::swap(down.triangles[i + 1], down.triangles[i + 2]);
  EXPECT_NE(refusal(down).find("no triangle faces up"), std::string::npos) << refusal(down);

  MeshTerrain line = patch(3, 3, 1);
  line.vertices[0] = line.vertices[4] + 2.0 * (line.vertices[1] - line.vertices[4]);
  EXPECT_NE(refusal(line).find("triangle 0 (0, 1, 4) has no area"), std::string::npos) << refusal(line);
}

TEST(MeshTerrain, WantsAnUndersideBetweenLayers) {
  MeshTerrain mesh = patch(8, 8, 1);
  const MeshTerrain bridge = patch(2, 2, 1.5, kFar + Vec3d{0.2, 0.1, 4});
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), bridge.vertices.begin(), bridge.vertices.end());
  for (const std::uint32_t v : bridge.triangles) mesh.triangles.push_back(first + v);
  EXPECT_NE(refusal(mesh).find("lie above each other; expected an underside"), std::string::npos) << refusal(mesh);

  // Beside the ground, and touching it along an edge, it is only an island.
  for (std::uint32_t v = first; v < mesh.vertices.size(); ++v) mesh.vertices[v] += Vec3d{4.05, 0, 0};
  EXPECT_EQ(refusal(mesh), "accepted");
}

TEST(MeshTerrain, RandomGroundHasItsHeights) {
  test::Random random(7);
  for (int round = 0; round < 20; ++round) {
    MeshTerrain mesh = patch(12, 9, 2);
    for (Vec3d& p : mesh.vertices) p += Vec3d{random.in(-0.4, 0.4), random.in(-0.4, 0.4), random.in(-3.0, 3.0)};
    const World world = make_world(scene_on(mesh, "dry_sand"));
    for (const Vec3d& p : mesh.vertices) {
      const double z = world.ground_height(p.x, p.y);
      if (std::isnan(z)) continue;  // at the border rounding may lose it
      EXPECT_NEAR(z, p.z, 1e-2);
    }
    const Vec3d inside = mesh.vertices[4 * 12 + 6];
    EXPECT_NEAR(world.ground_height(inside.x, inside.y), inside.z, 1e-3);
  }
}

TEST(MeshTerrain, ABombLeavesTheCraterItLeavesOnAGrid) {
  Scene on_mesh = scene_on(patch(61, 61, 1, {}), "dry_sand");
  on_mesh.bombs = {{.position = {0.5, 0.5, 0}, .above_ground = true, .yield = 0.05}};
  Scene on_grid = on_mesh;
  on_grid.terrain.shape = GridTerrain{.columns = 61, .rows = 61, .spacing = 1};
  World mesh = make_world(on_mesh), grid = make_world(on_grid);
  run_to(mesh, 3);
  run_to(grid, 3);
  ASSERT_EQ(mesh.craters().size(), 1u);
  const Crater a = mesh.craters()[0], b = grid.craters().at(0);
  ASSERT_GT(b.depth, 0.1);
  EXPECT_NEAR(a.width, b.width, 0.1 * b.width);
  EXPECT_NEAR(a.depth, b.depth, 0.1 * b.depth);
  EXPECT_LT(mesh.soil_volume().relative_error(), 0.02);
  EXPECT_TRUE(test::all_finite(mesh));
}

TEST(MeshTerrain, ABallRollsAndLeavesARut) {
  Scene scene = scene_on(patch(81, 31, 0.15), "mud");
  scene.bodies = {{.name = "wheel",
                   .shape = Sphere{0.6},
                   .mass = 500,
                   .position = kFar + Vec3d{-3, 0, -kFar.z},
                   .above_ground = true,
                   .velocity = {4, 0, 0}}};
  World world = make_world(scene, 2), again = make_world(scene, 1);
  run_to(world, 1);
  run_to(again, 1);
  EXPECT_EQ(world.state_hash(), again.state_hash());
  EXPECT_GT(world.bodies()[0].position.x, kFar.x - 2.5);
  EXPECT_LT(world.ground_height(kFar.x - 2.7, kFar.y), kFar.z - 0.02);
  EXPECT_FALSE(world.take_dirty().empty());
}

TEST(MeshTerrain, HasNoRasterAndWritesTheRest) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "divot_mesh_terrain";
  std::filesystem::remove_all(folder);
  Scene scene = scene_on(patch(9, 9, 1), "dry_sand");
  scene.output.formats = {"ply", "tif", "csv"};
  World world = make_world(scene);
  world.step();
  EXPECT_FALSE(world.raster().has_value());
  auto recorder = Recorder::create(folder.string());
  ASSERT_TRUE(recorder);
  EXPECT_TRUE(recorder->write_frame(world));
  EXPECT_TRUE(recorder->finish(world, {}));
  for (const char* written : {"frame_000000.ply", "terrain_final.ply", "terrain_final.csv", "summary.json"})
    EXPECT_TRUE(std::filesystem::exists(folder / written)) << written;
  for (const char* left_out : {"frame_000000.tif", "terrain_final.tif"})
    EXPECT_FALSE(std::filesystem::exists(folder / left_out)) << left_out;
  std::filesystem::remove_all(folder);
}

TEST(MeshTerrain, ASceneFileNamesOne) {
  const auto scene = parse_scene("[terrain]\nmesh = \"a.obj\"\nup = \"y\"\nscale = 0.01\n", "here/a.toml");
  ASSERT_TRUE(scene) << scene.error().front().text();
  const auto& mesh = std::get<MeshTerrain>(scene->terrain.shape);
  EXPECT_EQ(mesh.path, "a.obj");
  EXPECT_EQ(mesh.up, UpAxis::y);
  EXPECT_EQ(mesh.scale, 0.01);
  const auto world = World::create(*scene);
  ASSERT_FALSE(world);
  EXPECT_EQ(world.error().front().text(), "here/a.obj: terrain.mesh: cannot be read: No such file or directory");
}

}  // namespace
}  // namespace divot
