#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "divot/vec.h"

namespace divot::geometry {

/// A convex polyhedron.
struct ConvexHull {
  struct Plane {
    Vec3d normal;       // unit, outward
    double offset = 0;  // m: normal . p = offset on the face
  };
  struct Edge {
    std::uint32_t a = 0, b = 0;         // corners
    std::uint32_t left = 0, right = 0;  // faces
  };
  std::vector<Vec3d> corners;            // m
  std::vector<std::uint32_t> triangles;  // [3 * triangle] corners, outward
  std::vector<Plane> faces;
  std::vector<Edge> edges;
};

/// The hull of points; nothing when they do not span a volume. [O(n log n)]
std::optional<ConvexHull> convex_hull(std::span<const Vec3d> points);

}  // namespace divot::geometry
