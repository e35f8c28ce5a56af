#include "state/region.h"

#include <algorithm>
#include <array>

namespace divot::state {

void faces_near(const Surface& surface, const geometry::Bvh& bvh, const math::Aabb& box,
                std::vector<std::uint32_t>& faces) {
  if (!surface.bisection.any()) return bvh.query(box, faces);
  // Parts of a face lie within it from above, but for how far its corners and theirs have strayed; they may stand
  // higher and lower.
  math::Aabb column = box;
  const float stray = 2 * surface.strayed;
  column.low.x -= stray, column.low.y -= stray, column.low.z = -math::Aabb::kInf;
  column.high.x += stray, column.high.y += stray, column.high.z = math::Aabb::kInf;
  const auto box_of = [&](const std::array<std::uint32_t, 3>& corner) {
    math::Aabb around;
    for (const std::uint32_t v : corner) around.include(surface.position[v]);
    return around;
  };
  std::vector<std::uint32_t> bases;
  bvh.query(column, bases);
  for (const std::uint32_t base : bases)
    surface.bisection.for_each_part(
        base, [&](const auto& corner) { return box_of(corner).overlaps(column); },
        [&](std::uint32_t face) {
          const std::array corner{surface.mesh.origin(3 * face), surface.mesh.origin(3 * face + 1),
                                  surface.mesh.origin(3 * face + 2)};
          if (box_of(corner).overlaps(box)) faces.push_back(face);
        });
  std::sort(faces.begin(), faces.end());
}

void vertices_near(const Surface& surface, const geometry::Bvh& bvh, const math::Aabb& box, RegionScratch& scratch,
                   std::vector<std::uint32_t>& vertices) {
  scratch.faces.clear();
  faces_near(surface, bvh, box, scratch.faces);
  vertices.clear();
  for (const std::uint32_t face : scratch.faces)
    for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h) vertices.push_back(surface.mesh.origin(h));
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
}

SurfacePoint surface_at(const Surface& surface, const geometry::Bvh& bvh, float x, float y, RegionScratch& scratch) {
  math::Aabb line;
  line.include(Vec3{x, y, -math::Aabb::kInf});
  line.include(Vec3{x, y, math::Aabb::kInf});
  scratch.faces.clear();
  faces_near(surface, bvh, line, scratch.faces);
  SurfacePoint best;
  for (const std::uint32_t face : scratch.faces) {
    const std::uint32_t corner[3] = {surface.mesh.origin(3 * face), surface.mesh.origin(3 * face + 1),
                                     surface.mesh.origin(3 * face + 2)};
    const Vec3 a = surface.position[corner[0]], b = surface.position[corner[1]], c = surface.position[corner[2]];
    const auto side = [&](const Vec3& p, const Vec3& q) { return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x); };
    const float w[3] = {side(b, c), side(c, a), side(a, b)};
    const float total = w[0] + w[1] + w[2];
    if (!(total > 0) || w[0] < 0 || w[1] < 0 || w[2] < 0) continue;
    const float z = (w[0] * a.z + w[1] * b.z + w[2] * c.z) / total;
    if (best.found && z <= best.position.z) continue;
    best = {true, {x, y, z}, corner[std::max_element(w, w + 3) - w]};
  }
  return best;
}

double move_vertex(Surface& surface, std::uint32_t vertex, const Vec3& to) {
  // Each face sweeps a tetrahedron: the triple product of the vertex's way and the face's other two edges.
  const Vec3d from = to_double(surface.position[vertex]);
  Vec3d area;
  surface.mesh.for_each_outgoing(vertex, [&](std::uint32_t h) {
    const Vec3d a = to_double(surface.position[surface.mesh.target(h)]) - from;
    const Vec3d b = to_double(surface.position[surface.mesh.origin(geometry::HalfEdgeMesh::prev(h))]) - from;
    area += cross(a, b);
  });
  surface.position[vertex] = to;
  return dot(from - to_double(to), area) / 6;
}

Vec3 vertex_normal(const Surface& surface, std::uint32_t vertex) {
  Vec3 sum;
  const Vec3 p = surface.position[vertex];
  surface.mesh.for_each_outgoing(vertex, [&](std::uint32_t h) {
    sum += cross(surface.position[surface.mesh.target(h)] - p,
                 surface.position[surface.mesh.origin(geometry::HalfEdgeMesh::prev(h))] - p);
  });
  return normalized(sum);
}

}  // namespace divot::state
