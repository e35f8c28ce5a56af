#include "state/region.h"

#include <algorithm>
#include <array>
#include <optional>

namespace divot::state {
namespace {

// Where an upright line meets a face.
struct Crossing {
  std::array<float, 3> weight;  // of each corner, of any sum
  bool from_above;              // the face's corners run counter-clockwise from above
  float z;                      // m
};

std::optional<Crossing> meet(const Surface& surface, const std::array<std::uint32_t, 3>& vertex, float x, float y) {
  const Vec3 a = surface.position[vertex[0]], b = surface.position[vertex[1]], c = surface.position[vertex[2]];
  const auto side = [&](const Vec3& p, const Vec3& q) { return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x); };
  const std::array<float, 3> w{side(b, c), side(c, a), side(a, b)};
  const float total = w[0] + w[1] + w[2];
  const auto is_out = [&](float one) { return total > 0 ? one < 0 : one > 0; };
  if (!(total != 0) || std::any_of(w.begin(), w.end(), is_out)) return std::nullopt;
  return Crossing{w, total > 0, (w[0] * a.z + w[1] * b.z + w[2] * c.z) / total};
}

math::Aabb upright(float x, float y, float low, float high) {
  math::Aabb line;
  line.include(Vec3{x, y, low});
  line.include(Vec3{x, y, high});
  return line;
}

// Calls f for each point of the ground over x, y, in no order of height.
template <class F>
void for_each_ground(const Surface& surface, const geometry::Bvh& bvh, float x, float y, RegionScratch& scratch, F f) {
  scratch.faces.clear();
  faces_near(surface, bvh, upright(x, y, -math::Aabb::kInf, math::Aabb::kInf), scratch.faces);
  for (const std::uint32_t face : scratch.faces) {
    const std::array corner{surface.mesh.origin(3 * face), surface.mesh.origin(3 * face + 1),
                            surface.mesh.origin(3 * face + 2)};
    const auto met = meet(surface, corner, x, y);
    if (!met || !met->from_above) continue;
    const auto nearest = std::max_element(met->weight.begin(), met->weight.end()) - met->weight.begin();
    f(SurfacePoint{true, {x, y, met->z}, corner[static_cast<std::size_t>(nearest)], face});
  }
}

}  // namespace

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
  SurfacePoint best;
  for_each_ground(surface, bvh, x, y, scratch, [&](const SurfacePoint& point) {
    if (!best.found || point.position.z > best.position.z) best = point;
  });
  return best;
}

SurfacePoint surface_at(const Surface& surface, const geometry::Bvh& bvh, const Vec3& place, RegionScratch& scratch) {
  if (!surface.rigid.any()) return surface_at(surface, bvh, place.x, place.y, scratch);
  SurfacePoint above, below;
  for_each_ground(surface, bvh, place.x, place.y, scratch, [&](const SurfacePoint& point) {
    const float z = point.position.z;
    if (z > place.z && (!above.found || z < above.position.z)) above = point;
    if (z <= place.z && (!below.found || z > below.position.z)) below = point;
  });
  const bool inside = above.found && !rigid_between(surface, place.x, place.y, place.z, above.position.z, scratch);
  return inside || !below.found ? above : below;
}

bool rigid_between(const Surface& surface, float x, float y, float z0, float z1, RegionScratch& scratch) {
  if (!surface.rigid.any()) return false;
  const float low = std::min(z0, z1), high = std::max(z0, z1);
  scratch.faces.clear();
  surface.rigid.bvh.query(upright(x, y, low, high), scratch.faces);
  return std::any_of(scratch.faces.begin(), scratch.faces.end(), [&](std::uint32_t face) {
    const std::uint32_t* corner = &surface.rigid.triangles[3 * face];
    const auto met = meet(surface, {corner[0], corner[1], corner[2]}, x, y);
    return met && met->z >= low && met->z <= high;
  });
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
