#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "output/body_mesh.h"

namespace divot {
namespace {

using output::body_mesh;
using output::BodyMesh;

// m^3, by the divergence theorem: right only if every face is there and looks outward.
double volume(const BodyMesh& mesh) {
  double six_fold = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const auto corner = [&](std::size_t k) { return mesh.vertices.at(mesh.triangles[t + k]); };
    six_fold += dot(corner(0), cross(corner(1), corner(2)));
  }
  return six_fold / 6;
}

std::pair<Vec3d, Vec3d> bounds(const BodyMesh& mesh) {
  Vec3d low = mesh.vertices.front(), high = low;
  for (const Vec3d& p : mesh.vertices) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return {low, high};
}

struct Expected {
  const char* name;
  Shape shape;
  double volume;
  Vec3d low, high;
};

Part box_at(Vec3d position, Vec3d rotation_deg) {
  return {.shape = Box{.size = {2, 1, 1}}, .position = position, .rotation_deg = rotation_deg};
}

TEST(BodyMesh, HasTheVolumeAndTheReachOfItsShape) {
  const double pi = std::numbers::pi;
  const Hull tetrahedron = {.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                            .triangles = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}};
  const std::array<Expected, 7> cases = {{
      {"sphere", Sphere{.radius = 2}, 4. / 3 * pi * 8, {-2, -2, -2}, {2, 2, 2}},
      {"box", Box{.size = {1, 2, 3}}, 6, {-0.5, -1, -1.5}, {0.5, 1, 1.5}},
      {"cylinder", Cylinder{.radius = 1, .length = 3}, 3 * pi, {-1, -1.5, -1}, {1, 1.5, 1}},
      {"capsule", Capsule{.radius = 1, .length = 3}, (3 + 4. / 3) * pi, {-1, -2.5, -1}, {1, 2.5, 1}},
      {"cone", Cone{.radius = 1, .height = 3}, pi, {-1, -1, -1.5}, {1, 1, 1.5}},
      {"hull", tetrahedron, 1. / 6, {0, 0, 0}, {1, 1, 1}},
      // Two boxes, one of them turned from x to y.
      {"compound",
       Compound{.parts = {box_at({0, 0, 0}, {}), box_at({4, 0, 0}, {0, 0, 90})}},
       4,
       {-1, -1, -0.5},
       {4.5, 1, 0.5}},
  }};
  for (const Expected& expected : cases) {
    SCOPED_TRACE(expected.name);
    const BodyMesh mesh = body_mesh(expected.shape);
    // What is round is drawn with 32 flat sides, which hold up to 2 % less.
    EXPECT_NEAR(volume(mesh), expected.volume, 0.02 * expected.volume);
    EXPECT_LE(volume(mesh), expected.volume * (1 + 1e-12));
    const auto [low, high] = bounds(mesh);
    for (const auto& [got, want] : {std::pair{low, expected.low}, std::pair{high, expected.high}})
      EXPECT_LT(length(got - want), 1e-9) << got.x << ' ' << got.y << ' ' << got.z;
  }
}

}  // namespace
}  // namespace divot
