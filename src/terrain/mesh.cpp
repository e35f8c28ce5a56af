#include "terrain/mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "geometry/bvh.h"

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

Result<void> check_facing(const Surface& surface) {
  for (std::uint32_t face = 0; face < surface.mesh.face_count(); ++face) {
    const auto [id, at] = corners_of(surface, face);
    const double seen = area2(at[0], at[1], at[2]);
    if (seen > 0) continue;
    return refuse(fmt::format("triangle {} ({}, {}, {}) {}", face, id[0], id[1], id[2],
                              seen < 0 ? "faces down" : "stands upright or has no area"),
                  "expected triangles that are counter-clockwise from above: this version knows no overhangs");
  }
  return {};
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

// Bodies and soil know one height at each place.
Result<void> check_layers(const Surface& surface) {
  geometry::Bvh bvh;
  bvh.build(surface.mesh.face_count(), geometry::corners_in(surface.mesh.triangles()), surface.position, 0,
            geometry::Bvh::Order::by_place, Jobs(1));
  std::vector<std::uint32_t> found;
  for (std::uint32_t face = 0; face < surface.mesh.face_count(); ++face) {
    const auto [id, at] = corners_of(surface, face);
    std::optional<std::uint32_t> other = face_at(surface, bvh, (at[0] + at[1] + at[2]) * (1.0 / 3), id, found);
    for (std::size_t k = 0; k < 3 && !other; ++k) other = face_at(surface, bvh, at[k], std::span(&id[k], 1), found);
    if (other) {
      return refuse(
          fmt::format("triangles {} and {} lie above each other", std::min(face, *other), std::max(face, *other)),
          "expected one height at each place: this version knows no overhangs");
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

  Surface surface;
  surface.origin = center_of(mesh);
  surface.position = local_positions(mesh, *connected, surface.origin);
  surface.mesh = std::move(*connected);
  if (auto ok = check_facing(surface); !ok) return tl::unexpected(ok.error());
  if (auto ok = check_layers(surface); !ok) return tl::unexpected(ok.error());
  surface.material.assign(count, 0);
  surface.column.assign(count, kNone);
  surface.spacing = mean_spacing(surface);
  return surface;
}

}  // namespace divot::terrain
