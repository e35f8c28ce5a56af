#include "terrain/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "geometry/bvh.h"
#include "state/region.h"

namespace divot::terrain {
namespace {

using geometry::HalfEdgeMesh;
using state::Surface;

tl::unexpected<Errors> refuse(std::string problem, std::string expected) {
  return fail({.key = "terrain.mesh", .problem = std::move(problem), .expected = std::move(expected)});
}

Result<void> check_numbers(const MeshTerrain& mesh, std::uint64_t max_vertices) {
  if (mesh.triangles.empty()) return refuse("the mesh has no triangles", "expected at least one");
  const std::uint64_t most = std::min<std::uint64_t>(max_vertices, kNone - 1);
  if (mesh.vertices.size() > most) {
    return refuse(fmt::format("{} vertices are more than the limit of {}", mesh.vertices.size(), most),
                  "expected a smaller mesh or a higher `terrain.max_vertices`");
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3d& p = mesh.vertices[v];
    if (!is_finite(p)) {
      return refuse(fmt::format("vertex {} at ({}, {}, {}) is not finite", v, p.x, p.y, p.z),
                    "expected numbers of metres");
    }
  }
  return {};
}

// Of the vertices that triangles use: one that was left over far away must not cost the others their digits.
Vec3d center_of(const MeshTerrain& mesh) {
  Vec3d low = mesh.vertices[mesh.triangles.front()], high = low;
  for (const std::uint32_t v : mesh.triangles) {
    const Vec3d& p = mesh.vertices[v];
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return low + (high - low) * 0.5;
}

// A vertex without a face stands at the centre, like a hole: nothing touches it, but whoever loops over all vertices
// meets numbers of the terrain's size.
std::vector<Vec3> local_positions(const MeshTerrain& mesh, const HalfEdgeMesh& connected, const Vec3d& origin) {
  std::vector<Vec3> out(mesh.vertices.size());
  for (std::uint32_t v = 0; v < out.size(); ++v)
    if (connected.outgoing(v) != kNone) out[v] = to_float(mesh.vertices[v] - origin);
  return out;
}

// Steeper than this, the sine of the angle to the upright, a face bears nothing: columns of soil stand upright.
constexpr double kSteepest = 0.1;

// [face] Does it face up? Fails on a face without an area and where none does.
Result<std::vector<bool>> faces_up(const MeshTerrain& mesh) {
  std::vector<bool> up(mesh.triangles.size() / 3);
  for (std::size_t face = 0; face < up.size(); ++face) {
    const std::uint32_t* id = &mesh.triangles[3 * face];
    const Vec3d a = mesh.vertices[id[0]];
    const Vec3d across = cross(mesh.vertices[id[1]] - a, mesh.vertices[id[2]] - a);
    if (!(length(across) > 0))
      return refuse(fmt::format("triangle {} ({}, {}, {}) has no area", face, id[0], id[1], id[2]),
                    "expected corners that do not lie in a line");
    up[face] = across.z > kSteepest * length(across);
  }
  if (std::find(up.begin(), up.end(), true) == up.end())
    return refuse("no triangle faces up",
                  "expected corners counter-clockwise as seen from above, or from outside of what is closed");
  return up;
}

// Parts the faces that do not face up from the ground. Where ground would touch itself in one vertex only, each part
// but one gets a vertex of its own.
void part_rigid(const HalfEdgeMesh& whole, const std::vector<bool>& up, Surface& surface,
                std::vector<std::uint32_t>& ground) {
  std::vector<std::uint32_t> corner(whole.triangles().begin(), whole.triangles().end());
  surface.rigid.first_copy = whole.vertex_count();
  std::vector<std::uint32_t> around;
  for (std::uint32_t v = 0; v < whole.vertex_count(); ++v) {
    around.clear();
    whole.for_each_outgoing(v, [&](std::uint32_t h) { around.push_back(h); });
    const auto is_ground = [&](std::size_t k) { return up[HalfEdgeMesh::face_of(around[k % around.size()])]; };
    // From a rigid face on, so that no part is met in two pieces; at a border the walk has begun at its end.
    std::size_t start = 0;
    if (!around.empty() && !whole.is_boundary(v))
      while (start + 1 < around.size() && is_ground(start)) ++start;
    std::uint32_t id = kNone;
    bool first = true;
    for (std::size_t k = start; k < start + around.size(); ++k) {
      if (!is_ground(k)) {
        id = kNone;
        continue;
      }
      if (id == kNone) {
        id = v;
        if (!first) {
          id = surface.rigid.first_copy + static_cast<std::uint32_t>(surface.rigid.copies.size());
          surface.rigid.copies.push_back(v);
        }
        first = false;
      }
      corner[around[k % around.size()]] = id;
    }
  }
  for (std::size_t face = 0; face < up.size(); ++face) {
    auto& list = up[face] ? ground : surface.rigid.triangles;
    list.insert(list.end(), corner.begin() + 3 * static_cast<std::ptrdiff_t>(face),
                corner.begin() + 3 * static_cast<std::ptrdiff_t>(face) + 3);
  }
}

struct Corners {
  std::array<std::uint32_t, 3> id;
  std::array<Vec3d, 3> at;
};

Corners corners_of(const Surface& surface, std::uint32_t face) {
  Corners c;
  for (std::uint32_t k = 0; k < 3; ++k) {
    c.id[k] = surface.mesh.origin(3 * face + k);
    c.at[k] = to_double(surface.position[c.id[k]]);
  }
  return c;
}

// Twice the area of a triangle seen from above, m^2: > 0 where it is counter-clockwise.
double area2(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Height of a face's plane at a place, m.
float height_of(const Surface& surface, std::uint32_t face, const Vec3d& p) {
  const auto [id, at] = corners_of(surface, face);
  const Vec3d across = cross(at[1] - at[0], at[2] - at[0]);
  return static_cast<float>(at[0].z - (across.x * (p.x - at[0].x) + across.y * (p.y - at[0].y)) / across.z);
}

// A face with x, y inside it, not on its edge, that has none of the corners `but`.
std::optional<std::uint32_t> face_at(const Surface& surface, const geometry::Bvh& bvh, const Vec3d& p,
                                     std::span<const std::uint32_t> but, std::vector<std::uint32_t>& faces) {
  math::Aabb line;
  line.include(Vec3{static_cast<float>(p.x), static_cast<float>(p.y), -math::Aabb::kInf});
  line.include(Vec3{static_cast<float>(p.x), static_cast<float>(p.y), math::Aabb::kInf});
  faces.clear();
  bvh.query(line, faces);
  for (const std::uint32_t face : faces) {
    const auto [id, at] = corners_of(surface, face);
    if (std::find_first_of(id.begin(), id.end(), but.begin(), but.end()) != id.end()) continue;
    // Parts of a terrain that do not share vertices may touch along their edges, where rounding decides.
    const double edge = 1e-6 * area2(at[0], at[1], at[2]);
    if (area2(at[0], at[1], p) > edge && area2(at[1], at[2], p) > edge && area2(at[2], at[0], p) > edge) return face;
  }
  return std::nullopt;
}

// Ground over ground must have an underside, which tells what is below it from what is in it. Asked at the middle of
// each face and just inside its corners.
Result<void> check_layers(const Surface& surface) {
  geometry::Bvh bvh;
  bvh.build(surface.mesh.face_count(), geometry::corners_in(surface.mesh.triangles()), surface.position, 0,
            geometry::Bvh::Order::by_place, Jobs(1));
  std::vector<std::uint32_t> found;
  state::RegionScratch scratch;
  for (std::uint32_t face = 0; face < surface.mesh.face_count(); ++face) {
    const auto [id, at] = corners_of(surface, face);
    const Vec3d middle = (at[0] + at[1] + at[2]) * (1.0 / 3);
    for (const Vec3d& p : {middle, at[0], at[1], at[2]}) {
      const Vec3d inside = p + (middle - p) * 0.01;
      const auto other = face_at(surface, bvh, inside, id, found);
      if (!other) continue;
      const auto x = static_cast<float>(inside.x), y = static_cast<float>(inside.y);
      if (state::rigid_between(surface, x, y, static_cast<float>(inside.z), height_of(surface, *other, inside),
                               scratch))
        continue;
      return refuse(fmt::format("triangles {} and {} of those that face up lie above each other",
                                std::min(face, *other), std::max(face, *other)),
                    "expected an underside between them");
    }
  }
  return {};
}

float mean_spacing(const Surface& surface) {
  const HalfEdgeMesh& mesh = surface.mesh;
  double sum = 0;
  std::uint64_t edges = 0;
  for (std::uint32_t h = 0; h < mesh.half_edge_count(); ++h) {
    if (mesh.twin(h) != kNone && mesh.twin(h) < h) continue;  // each edge once
    const Vec3d along = to_double(surface.position[mesh.target(h)]) - to_double(surface.position[mesh.origin(h)]);
    sum += std::hypot(along.x, along.y);
    ++edges;
  }
  return static_cast<float>(sum / static_cast<double>(edges));
}

}  // namespace

Result<Surface> load_mesh(const MeshTerrain& mesh, std::uint64_t max_vertices) {
  if (auto ok = check_numbers(mesh, max_vertices); !ok) return tl::unexpected(ok.error());
  const auto count = static_cast<std::uint32_t>(mesh.vertices.size());
  auto connected = HalfEdgeMesh::build(count, mesh.triangles, [&](std::uint32_t v) {
    const Vec3d& p = mesh.vertices[v];
    return fmt::format("({:.10g}, {:.10g}, {:.10g})", p.x, p.y, p.z);
  });
  if (!connected) {
    Error error = connected.error().front();
    return refuse(std::move(error.problem), "expected " + error.expected);
  }

  const auto up = faces_up(mesh);
  if (!up) return tl::unexpected(up.error());

  Surface surface;
  surface.origin = center_of(mesh);
  surface.position = local_positions(mesh, *connected, surface.origin);
  if (std::find(up->begin(), up->end(), false) == up->end()) {
    surface.mesh = std::move(*connected);
  } else {
    std::vector<std::uint32_t> ground;
    part_rigid(*connected, *up, surface, ground);
    for (const std::uint32_t v : surface.rigid.copies) surface.position.push_back(surface.position[v]);
    surface.rigid.bvh.build(static_cast<std::uint32_t>(surface.rigid.triangles.size() / 3),
                            geometry::corners_in(surface.rigid.triangles), surface.position, 0,
                            geometry::Bvh::Order::by_place, Jobs(1));
    surface.mesh = HalfEdgeMesh::build(static_cast<std::uint32_t>(surface.position.size()), std::move(ground)).value();
  }
  if (auto ok = check_layers(surface); !ok) return tl::unexpected(ok.error());
  surface.material.assign(surface.position.size(), 0);
  surface.column.assign(surface.position.size(), kNone);
  surface.spacing = mean_spacing(surface);
  return surface;
}

}  // namespace divot::terrain
