// Ground that hangs over itself: what does not face up is rigid, and each layer answers for itself.
#include <algorithm>
#include <array>
#include <map>

#include "support.h"
#include "terrain/mesh.h"

namespace divot {
namespace {

using test::make_world;
using test::run_to;

constexpr double kSpacing = 0.25;

// Appends a rectangle of ground, facing up or down; returns the vertices round its border, counter-clockwise from
// above.
std::vector<std::uint32_t> add_sheet(MeshTerrain& mesh, double x, double y, double z, std::uint32_t columns,
                                     std::uint32_t rows, bool up) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto at = [&](std::uint32_t column, std::uint32_t row) { return first + row * columns + column; };
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column)
      mesh.vertices.push_back({x + kSpacing * column, y + kSpacing * row, z});
  for (std::uint32_t row = 0; row + 1 < rows; ++row)
    for (std::uint32_t column = 0; column + 1 < columns; ++column) {
      const std::uint32_t a = at(column, row), b = at(column + 1, row), c = at(column, row + 1),
                          d = at(column + 1, row + 1);
      if (up)
        mesh.triangles.insert(mesh.triangles.end(), {a, b, d, a, d, c});
      else
        mesh.triangles.insert(mesh.triangles.end(), {a, d, b, a, c, d});
    }
  std::vector<std::uint32_t> border;
  for (std::uint32_t k = 0; k + 1 < columns; ++k) border.push_back(at(k, 0));
  for (std::uint32_t k = 0; k + 1 < rows; ++k) border.push_back(at(columns - 1, k));
  for (std::uint32_t k = columns - 1; k > 0; --k) border.push_back(at(k, rows - 1));
  for (std::uint32_t k = rows - 1; k > 0; --k) border.push_back(at(0, k));
  return border;
}

void close(MeshTerrain& mesh, const std::vector<std::uint32_t>& top, const std::vector<std::uint32_t>& bottom) {
  for (std::size_t k = 0; k < top.size(); ++k) {
    const std::size_t next = (k + 1) % top.size();
    mesh.triangles.insert(mesh.triangles.end(), {bottom[k], bottom[next], top[next], bottom[k], top[next], top[k]});
  }
}

// 16 x 12 m of ground, and 3 m over its middle the underside of a deck of 6 x 8 m that is 1 m thick.
MeshTerrain bridge() {
  MeshTerrain mesh;
  add_sheet(mesh, -8, -6, 0, 65, 49, true);
  const auto top = add_sheet(mesh, -3, -4, 4, 25, 33, true), bottom = add_sheet(mesh, -3, -4, 3, 25, 33, false);
  close(mesh, top, bottom);
  return mesh;
}

Scene scene_on(MeshTerrain mesh) {
  Scene scene;
  scene.terrain = {.shape = std::move(mesh), .material = "dry_sand"};
  return scene;
}

BodySettings ball(const std::string& name, double radius, double mass, const Vec3d& position, const Vec3d& velocity) {
  return {.name = name, .shape = Sphere{radius}, .mass = mass, .position = position, .velocity = velocity};
}

double largest_change(const World& world, double low, double high) {
  double most = 0;
  for (std::uint32_t v = 0; v < world.surface().positions.size(); ++v) {
    const double z = world.surface().positions[v].z + world.surface().origin.z + world.sinkage(v);
    if (z > low && z < high) most = std::max<double>(most, std::abs(world.sinkage(v)));
  }
  return most;
}

TEST(Overhang, WhatDoesNotFaceUpIsApart) {
  const auto surface = terrain::load_mesh(bridge(), 100'000);
  ASSERT_TRUE(surface);
  EXPECT_EQ(surface->mesh.validate(), "");
  EXPECT_EQ(surface->mesh.face_count(), 2u * (64 * 48 + 24 * 32));
  EXPECT_EQ(surface->rigid.triangles.size(), 3u * 2 * (24 * 32 + 2 * (24 + 32)));
  EXPECT_TRUE(surface->rigid.copies.empty());

  const World world = make_world(scene_on(bridge()));
  const SurfaceView view = world.surface();
  EXPECT_EQ(view.rigid, surface->rigid.triangles.size() / 3);
  EXPECT_EQ(view.triangles.size() / 3, view.rigid + surface->mesh.face_count());
  EXPECT_FLOAT_EQ(static_cast<float>(world.ground_height(0, 0)), 4);
  EXPECT_FLOAT_EQ(static_cast<float>(world.ground_height(5, 0)), 0);
}

TEST(Overhang, GroundThatTouchesItselfInAVertexIsParted) {
  // Two cells at opposite sides of a vertex; upright triangles fill what is open between them there.
  MeshTerrain mesh;
  add_sheet(mesh, 0, 0, 1, 3, 3, true);
  mesh.triangles.erase(mesh.triangles.begin() + 6, mesh.triangles.begin() + 18);
  for (const double z : {0.5, 0.0}) mesh.vertices.push_back({kSpacing, kSpacing, z});
  const std::uint32_t middle = 4, low = 9;
  mesh.triangles.insert(mesh.triangles.end(), {middle, 7, low, middle, low, 3});
  mesh.triangles.insert(mesh.triangles.end(), {middle, 1, low + 1, middle, low + 1, 5});
  const auto surface = terrain::load_mesh(mesh, 100);
  ASSERT_TRUE(surface) << surface.error().front().text();
  EXPECT_EQ(surface->mesh.validate(), "");
  EXPECT_EQ(surface->mesh.face_count(), 4u);
  EXPECT_EQ(surface->rigid.copies, std::vector<std::uint32_t>{middle});
  EXPECT_EQ(surface->position.back(), surface->position[middle]);
}

TEST(Overhang, EachLayerBearsWhatIsOnIt) {
  Scene scene = scene_on(bridge());
  scene.bodies = {ball("under", 1, 8000, {-6, 0, 1}, {5, 0, 0}), ball("over", 0.5, 1000, {1, 1, 4.5}, {})};
  World world = make_world(scene);
  run_to(world, 1.2);
  const auto bodies = world.bodies();
  EXPECT_GT(bodies[0].position.x, -3.5) << "it rolls in below the deck";
  EXPECT_GT(bodies[0].sinkage, 0.05);
  EXPECT_LT(bodies[0].sinkage, 0.5);
  EXPECT_NEAR(bodies[1].position.z, 4.5, 0.2);
  EXPECT_GT(bodies[1].sinkage, 0.02);
  EXPECT_GT(largest_change(world, -1, 1), 0.05);
  EXPECT_GT(largest_change(world, 3.5, 4.5), 0.02);
  EXPECT_EQ(largest_change(world, 2.9, 3.1), 0) << "undersides stand still";
}

TEST(Overhang, BodiesBumpIntoWallsAndUndersides) {
  Scene scene = scene_on(bridge());
  scene.bodies = {ball("wall", 0.3, 100, {-6, 0, 3.5}, {20, 0, 0}), ball("ceiling", 0.3, 100, {0, 2, 1}, {0, 0, 12})};
  World world = make_world(scene);
  double furthest = -10, highest = 0;
  while (world.time() < 0.4) {
    world.step();
    furthest = std::max(furthest, world.bodies()[0].position.x);
    highest = std::max(highest, world.bodies()[1].position.z);
  }
  EXPECT_LT(furthest, -2.9);
  EXPECT_LT(world.bodies()[0].velocity.x, 1);
  EXPECT_LT(highest, 3.0);
  EXPECT_LT(world.bodies()[1].velocity.z, 0);
}

TEST(Overhang, ABombOnTheDeckLeavesTheGroundBelow) {
  for (const double z : {4.0, 0.0}) {
    Scene scene = scene_on(bridge());
    scene.bombs = {{.position = {0.1, 0.1, z}, .yield = 0.005}};
    World world = make_world(scene);
    run_to(world, 1.5);
    const bool on_deck = z > 2;
    EXPECT_GT(largest_change(world, on_deck ? 3.5 : -1, on_deck ? 4.5 : 1), 0.1);
    EXPECT_EQ(largest_change(world, on_deck ? -1 : 3.5, on_deck ? 1 : 4.5), 0);
    ASSERT_EQ(world.craters().size(), 1u);
    EXPECT_NEAR(world.craters()[0].position.z, z, 0.01);
    EXPECT_GT(world.craters()[0].depth, 0.1);
  }
}

TEST(Overhang, AClosedBlockIsGroundOnItsTop) {
  MeshTerrain block;
  const auto top = add_sheet(block, -4, -4, 2, 33, 33, true), bottom = add_sheet(block, -4, -4, 0, 33, 33, false);
  close(block, top, bottom);
  Scene scene = scene_on(block);
  scene.bodies = {ball("ball", 1, 8000, {0, 0, 3}, {})};
  World world = make_world(scene);
  run_to(world, 1);
  EXPECT_NEAR(world.bodies()[0].position.z, 3 - world.bodies()[0].sinkage, 1e-3);
  EXPECT_GT(world.bodies()[0].sinkage, 0.02);
}

TEST(Overhang, TheSameForAnyNumberOfThreads) {
  Scene scene = scene_on(bridge());
  scene.bodies = {ball("under", 1, 8000, {-6, 0, 1}, {5, 0, 0}), ball("wall", 0.3, 100, {-6, 2, 3.5}, {20, 0, 0})};
  scene.bombs = {{.time = 0.3, .position = {0.1, 0.1, 4}, .yield = 0.005}};
  std::vector<std::uint64_t> hashes;
  for (const unsigned threads : {1u, 3u}) {
    auto world = World::create(scene, std::make_shared<const Jobs>(threads));
    ASSERT_TRUE(world);
    run_to(*world, 0.8);
    hashes.push_back(world->state_hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Overhang, RefinedGroundKeepsItsLayers) {
  Scene scene = scene_on(bridge());
  scene.terrain.refine.min_edge = 0.06;
  scene.bodies = {ball("under", 1, 8000, {-6, 0, 1}, {5, 0, 0})};
  World world = make_world(scene);
  const std::size_t before = world.surface().triangles.size();
  run_to(world, 1);
  const SurfaceView view = world.surface();
  EXPECT_GT(view.triangles.size(), before);
  // What lies behind the last triangle was there in between.
  const Topology change = world.take_topology();
  ASSERT_FALSE(change.empty());
  for (const DirtyRange& range : change.triangles) EXPECT_GE(range.first, view.rigid);
  EXPECT_EQ(largest_change(world, 2.9, 4.5), 0);
}

}  // namespace
}  // namespace divot
