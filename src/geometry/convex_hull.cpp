#include "geometry/convex_hull.h"

#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <cmath>

namespace divot::geometry {
namespace {

Vec3d from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

// Flatter than this share of their extent, points span no volume.
constexpr double kFlat = 1e-9;

}  // namespace

std::optional<ConvexHull> convex_hull(std::span<const Vec3d> points) {
  if (points.size() < 4) return std::nullopt;
  btConvexHullComputer computer;
  static_assert(sizeof(Vec3d) == 3 * sizeof(double));
  computer.compute(&points[0].x, sizeof(Vec3d), static_cast<int>(points.size()), 0, 0);

  ConvexHull hull;
  for (int i = 0; i < computer.vertices.size(); ++i) hull.corners.push_back(from_bullet(computer.vertices[i]));
  std::vector<std::uint32_t> face_of(static_cast<std::size_t>(computer.edges.size()), 0);
  double volume = 0, extent = 0;
  for (const Vec3d& p : hull.corners) extent = std::max(extent, length(p - hull.corners[0]));
  for (int f = 0; f < computer.faces.size(); ++f) {
    const btConvexHullComputer::Edge *first = &computer.edges[computer.faces[f]], *edge = first;
    std::vector<std::uint32_t> ring;
    do {
      face_of[static_cast<std::size_t>(edge - &computer.edges[0])] = static_cast<std::uint32_t>(hull.faces.size());
      ring.push_back(static_cast<std::uint32_t>(edge->getSourceVertex()));
      edge = edge->getNextEdgeOfFace();
    } while (edge != first);
    // Newell's normal.
    Vec3d normal;
    for (std::size_t k = 0; k < ring.size(); ++k)
      normal += cross(hull.corners[ring[k]] - hull.corners[ring[0]],
                      hull.corners[ring[(k + 1) % ring.size()]] - hull.corners[ring[0]]);
    const double size = length(normal);
    normal = size > 0 ? normal * (1 / size) : Vec3d{0, 0, 1};
    hull.faces.push_back({normal, dot(normal, hull.corners[ring[0]])});
    for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
      for (const std::size_t corner : {std::size_t{0}, k, k + 1}) hull.triangles.push_back(ring[corner]);
      const Vec3d a = hull.corners[ring[0]] - hull.corners[0], b = hull.corners[ring[k]] - hull.corners[0],
                  c = hull.corners[ring[k + 1]] - hull.corners[0];
      volume += dot(a, cross(b, c)) / 6;
    }
  }
  // Bullet lists a face's corners clockwise in some versions: the volume tells.
  if (volume < 0) {
    for (std::size_t t = 0; t < hull.triangles.size(); t += 3) std::swap(hull.triangles[t + 1], hull.triangles[t + 2]);
    for (ConvexHull::Plane& face : hull.faces) face.normal = -face.normal, face.offset = -face.offset;
  }
  if (!(std::abs(volume) > kFlat * extent * extent * extent)) return std::nullopt;
  for (int e = 0; e < computer.edges.size(); ++e) {
    const auto& edge = computer.edges[e];
    const auto back = static_cast<std::size_t>(edge.getReverseEdge() - &computer.edges[0]);
    if (static_cast<std::size_t>(e) < back)
      hull.edges.push_back({static_cast<std::uint32_t>(edge.getSourceVertex()),
                            static_cast<std::uint32_t>(edge.getTargetVertex()), face_of[static_cast<std::size_t>(e)],
                            face_of[back]});
  }
  return hull;
}

}  // namespace divot::geometry
