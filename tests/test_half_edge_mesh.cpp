#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <utility>

#include "geometry/half_edge_mesh.h"

namespace {

using divot::kNone;
using divot::geometry::HalfEdgeMesh;
using Indices = std::vector<std::uint32_t>;

// Quads of columns x rows vertices, each cut in two; `hole(column, row)` leaves a quad out.
template <class Hole>
Indices grid(std::uint32_t columns, std::uint32_t rows, Hole hole) {
  Indices triangles;
  for (std::uint32_t r = 0; r + 1 < rows; ++r)
    for (std::uint32_t c = 0; c + 1 < columns; ++c) {
      if (hole(c, r)) continue;
      const std::uint32_t v = r * columns + c, up = v + columns;
      triangles.insert(triangles.end(), {v, v + 1, up + 1, v, up + 1, up});
    }
  return triangles;
}

Indices grid(std::uint32_t columns, std::uint32_t rows) {
  return grid(columns, rows, [](std::uint32_t, std::uint32_t) { return false; });
}

HalfEdgeMesh mesh_of(std::uint32_t vertex_count, Indices triangles) {
  auto mesh = HalfEdgeMesh::build(vertex_count, std::move(triangles));
  EXPECT_TRUE(mesh.has_value()) << mesh.error().front().text();
  return mesh ? *mesh : HalfEdgeMesh();
}

std::string problem_of(std::uint32_t vertex_count, Indices triangles) {
  const auto mesh = HalfEdgeMesh::build(vertex_count, std::move(triangles));
  return mesh ? "none" : mesh.error().front().text();
}

// Vertices that have faces, minus edges, plus faces.
int euler_characteristic(const HalfEdgeMesh& mesh) {
  int used = 0, edges = 0;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) used += mesh.outgoing(v) != kNone;
  for (std::uint32_t h = 0; h < mesh.half_edge_count(); ++h) edges += mesh.twin(h) == kNone || h < mesh.twin(h);
  return used - edges + static_cast<int>(mesh.face_count());
}

std::size_t boundary_edges(const HalfEdgeMesh& mesh) {
  std::size_t count = 0;
  for (std::uint32_t h = 0; h < mesh.half_edge_count(); ++h) count += mesh.twin(h) == kNone;
  return count;
}

// Everything the mesh says, against maps filled from the triangles alone.
void expect_agrees_with_triangles(const HalfEdgeMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> directed;
  std::map<std::uint32_t, std::set<std::uint32_t>> neighbours, faces;
  const auto t = mesh.triangles();
  for (std::uint32_t h = 0; h < t.size(); ++h) {
    const std::uint32_t from = t[h], to = t[HalfEdgeMesh::next(h)];
    ASSERT_TRUE(directed.emplace(std::pair(from, to), h).second) << "edge " << from << "-" << to << " twice";
    neighbours[from].insert(to), neighbours[to].insert(from);
    faces[from].insert(h / 3);
  }
  std::set<std::uint32_t> at_boundary;
  for (const auto& [edge, h] : directed) {
    const auto back = directed.find({edge.second, edge.first});
    ASSERT_EQ(mesh.twin(h), back == directed.end() ? kNone : back->second);
    if (back == directed.end()) at_boundary.insert({edge.first, edge.second});
  }
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    Indices ring, fan;
    mesh.for_each_neighbour(v, [&](std::uint32_t n) { ring.push_back(n); });
    mesh.for_each_face(v, [&](std::uint32_t f) { fan.push_back(f); });
    std::sort(ring.begin(), ring.end()), std::sort(fan.begin(), fan.end());
    ASSERT_EQ(ring, Indices(neighbours[v].begin(), neighbours[v].end())) << "vertex " << v;
    ASSERT_EQ(fan, Indices(faces[v].begin(), faces[v].end())) << "vertex " << v;
    ASSERT_EQ(mesh.is_boundary(v), at_boundary.count(v) == 1) << "vertex " << v;
    ASSERT_EQ(mesh.outgoing(v) == kNone, faces[v].empty());
  }
}

TEST(HalfEdgeMesh, EmptyHasNothing) {
  const HalfEdgeMesh mesh;
  EXPECT_EQ(mesh.vertex_count(), 0u);
  EXPECT_EQ(mesh.face_count(), 0u);
  EXPECT_EQ(mesh.validate(), "");
  EXPECT_EQ(mesh_of(3, {}).outgoing(2), kNone);
}

TEST(HalfEdgeMesh, GridKnowsItsRingsAndBoundary) {
  const HalfEdgeMesh mesh = mesh_of(12, grid(4, 3));
  EXPECT_EQ(mesh.face_count(), 12u);
  EXPECT_EQ(mesh.validate(), "");
  EXPECT_EQ(euler_characteristic(mesh), 1);
  EXPECT_EQ(boundary_edges(mesh), 10u);

  // Vertex 5 is inside: its ring closes, counter-clockwise. Vertex 0 is a corner with both ends met.
  Indices ring;
  mesh.for_each_neighbour(5, [&](std::uint32_t n) { ring.push_back(n); });
  std::rotate(ring.begin(), std::find(ring.begin(), ring.end(), 6u), ring.end());
  EXPECT_EQ(ring, (Indices{6, 10, 9, 4, 0, 1}));
  EXPECT_FALSE(mesh.is_boundary(5));
  ring.clear();
  mesh.for_each_neighbour(0, [&](std::uint32_t n) { ring.push_back(n); });
  EXPECT_EQ(ring, (Indices{1, 5, 4}));
  EXPECT_TRUE(mesh.is_boundary(0));
  expect_agrees_with_triangles(mesh);
}

TEST(HalfEdgeMesh, HolesLeaveVerticesWithoutFaces) {
  // The four quads round the middle vertex of 5 x 5 are missing.
  const auto hole = [](std::uint32_t c, std::uint32_t r) { return (c == 1 || c == 2) && (r == 1 || r == 2); };
  const HalfEdgeMesh mesh = mesh_of(25, grid(5, 5, hole));
  EXPECT_EQ(mesh.outgoing(12), kNone);
  EXPECT_FALSE(mesh.is_boundary(12));
  EXPECT_TRUE(mesh.is_boundary(7));
  mesh.for_each_neighbour(12, [](std::uint32_t) { ADD_FAILURE(); });
  EXPECT_EQ(euler_characteristic(mesh), 0);  // an annulus
  EXPECT_EQ(mesh.validate(), "");
  expect_agrees_with_triangles(mesh);
}

TEST(HalfEdgeMesh, BadTrianglesAreNamed) {
  EXPECT_EQ(problem_of(3, {0, 1, 2, 0}), "4 triangle indices; three for each triangle, below 2^32 in all");
  EXPECT_EQ(problem_of(3, {0, 1, 2, 0, 2, 3}),
            "triangle 1 (0, 2, 3) names a vertex that does not exist; vertices below 3");
  EXPECT_EQ(problem_of(3, {0, 1, 2, 1, 1, 2}), "triangle 1 (1, 1, 2) has a vertex twice; three different vertices");
  EXPECT_EQ(problem_of(5, {0, 1, 2, 1, 0, 3, 0, 1, 4}),
            "edge 0-1 belongs to 3 triangles, first triangle 0 (0, 1, 2); at most two triangles at an edge");
  EXPECT_EQ(
      problem_of(4, {0, 1, 2, 0, 1, 3}),
      "triangle 0 (0, 1, 2) and triangle 1 (0, 1, 3) both run along edge 0-1 in the same direction; all triangles "
      "counter-clockwise from above");
  EXPECT_EQ(
      problem_of(5, {0, 1, 2, 0, 3, 4}),
      "only 1 of the 2 triangles at vertex 0 are joined by edges, from triangle 0 (0, 1, 2) on; one fan round each "
      "vertex; duplicate a vertex where two parts touch");
}

TEST(HalfEdgeMesh, FanOfManyTrianglesBuildsInLinearTime) {
  const std::uint32_t spokes = 300000;  // quadratic work would take minutes
  Indices triangles;
  for (std::uint32_t i = 1; i <= spokes; ++i) triangles.insert(triangles.end(), {0, i, i % spokes + 1});
  const HalfEdgeMesh mesh = mesh_of(spokes + 1, triangles);
  EXPECT_FALSE(mesh.is_boundary(0));
  EXPECT_EQ(boundary_edges(mesh), spokes);
}

TEST(HalfEdgeMesh, SplitMakesFourFacesOfTwo) {
  HalfEdgeMesh mesh = mesh_of(4, {0, 1, 2, 0, 2, 3});
  EXPECT_EQ(mesh.split_edge(2), 4u);  // the diagonal, 2 to 0
  EXPECT_EQ(mesh.face_count(), 4u);
  EXPECT_EQ(mesh.target(2), 4u);
  EXPECT_FALSE(mesh.is_boundary(4));
  EXPECT_EQ(mesh.split_edge(mesh.outgoing(0)), 5u);  // an edge of the boundary, 0 to 1
  EXPECT_EQ(mesh.face_count(), 5u);
  EXPECT_TRUE(mesh.is_boundary(5));
  EXPECT_EQ(mesh.validate(), "");
}

TEST(HalfEdgeMesh, FlipTakesTheOtherDiagonalAndBack) {
  HalfEdgeMesh mesh = mesh_of(4, {0, 1, 2, 0, 2, 3});
  EXPECT_FALSE(mesh.flip_edge(0));
  ASSERT_TRUE(mesh.flip_edge(2));
  EXPECT_EQ(std::min(mesh.origin(2), mesh.target(2)), 1u);
  EXPECT_EQ(std::max(mesh.origin(2), mesh.target(2)), 3u);
  EXPECT_EQ(mesh.validate(), "");

  // In a tetrahedron every other diagonal is an edge already.
  HalfEdgeMesh solid = mesh_of(4, {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2});
  for (std::uint32_t h = 0; h < 12; ++h) EXPECT_FALSE(solid.flip_edge(h));
}

TEST(HalfEdgeMesh, CollapseRefusesWhatWouldNotBeASurface) {
  HalfEdgeMesh triangle = mesh_of(3, {0, 1, 2});
  EXPECT_FALSE(triangle.collapse_edge(0));
  HalfEdgeMesh solid = mesh_of(4, {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2});
  EXPECT_FALSE(solid.collapse_edge(0));
  HalfEdgeMesh quad = mesh_of(4, {0, 1, 2, 0, 2, 3});
  EXPECT_FALSE(quad.collapse_edge(2));  // inside, but between two sides of the boundary
  EXPECT_TRUE(quad.collapse_edge(0));
  EXPECT_EQ(quad.face_count(), 1u);
  EXPECT_EQ(quad.outgoing(1), kNone);
  EXPECT_EQ(quad.validate(), "");
}

TEST(HalfEdgeMesh, CollapseKeepsTheOriginAndMovesTheLastFaces) {
  HalfEdgeMesh mesh = mesh_of(25, grid(5, 5));
  std::uint32_t h = mesh.outgoing(12);
  while (mesh.target(h) != 13) h = mesh.twin(HalfEdgeMesh::prev(h));
  ASSERT_TRUE(mesh.collapse_edge(h));
  EXPECT_EQ(mesh.face_count(), 30u);
  EXPECT_EQ(mesh.outgoing(13), kNone);
  const auto t = mesh.triangles();
  EXPECT_EQ(std::count(t.begin(), t.end(), 13u), 0);
  EXPECT_EQ(std::count(t.begin(), t.end(), 12u), 8);
  EXPECT_EQ(mesh.validate(), "");
}

// Thousands of edits at random keep every promise, the genus and the number of boundary loops.
TEST(HalfEdgeMesh, RandomEditsKeepTheSurface) {
  const auto hole = [](std::uint32_t c, std::uint32_t r) { return c == 3 && (r == 2 || r == 3); };
  HalfEdgeMesh mesh = mesh_of(80, grid(8, 10, hole));
  const int euler = euler_characteristic(mesh);
  ASSERT_EQ(euler, 0);
  std::mt19937 random(7);
  int splits = 0, flips = 0, collapses = 0, refused = 0;
  for (int i = 0; i < 12000; ++i) {
    const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
    const std::uint32_t h = below(mesh.half_edge_count()), kind = below(10);
    const Indices before(mesh.triangles().begin(), mesh.triangles().end());
    bool changed = true;
    // More collapses are asked for than splits, so that the mesh also gets small.
    if (kind < (mesh.face_count() > 300 ? 1u : 3u))
      mesh.split_edge(h), ++splits;
    else if (kind < 6)
      changed = mesh.flip_edge(h), flips += changed;
    else
      changed = mesh.collapse_edge(h), collapses += changed;
    if (!changed) {
      ++refused;
      ASSERT_TRUE(std::equal(before.begin(), before.end(), mesh.triangles().begin(), mesh.triangles().end()));
    }
    ASSERT_EQ(mesh.validate(), "") << "edit " << i;
    ASSERT_EQ(euler_characteristic(mesh), euler) << "edit " << i;
    if (i % 500 == 0) expect_agrees_with_triangles(mesh);
  }
  EXPECT_GT(splits, 1000);
  EXPECT_GT(flips, 1000);
  EXPECT_GT(collapses, 1000);
  EXPECT_GT(refused, 1000);
}

}  // namespace
