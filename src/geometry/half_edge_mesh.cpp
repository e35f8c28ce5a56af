#include "geometry/half_edge_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/assert.h"

namespace divot::geometry {
namespace {

using Indices = std::vector<std::uint32_t>;
using VertexText = std::function<std::string(std::uint32_t)>;

Error problem(std::string what, std::string expected) { return {{}, 0, {}, std::move(what), std::move(expected)}; }

std::string triangle_text(const Indices& triangles, std::size_t face) {
  return fmt::format("triangle {} ({}, {}, {})", face, triangles[3 * face], triangles[3 * face + 1],
                     triangles[3 * face + 2]);
}

std::string edge_text(std::uint32_t a, std::uint32_t b, const VertexText& vertex_text) {
  if (!vertex_text) return fmt::format("{}-{}", a, b);
  return fmt::format("{}-{}, from {} to {},", a, b, vertex_text(a), vertex_text(b));
}

// The first triangle that could not be in any mesh; no problem when all could.
Error check_triangles(std::uint32_t vertex_count, const Indices& triangles) {
  if (triangles.size() % 3 != 0 || triangles.size() >= kNone)
    return problem(fmt::format("{} triangle indices", triangles.size()), "three for each triangle, below 2^32 in all");
  for (std::size_t face = 0; face < triangles.size() / 3; ++face) {
    const std::uint32_t a = triangles[3 * face], b = triangles[3 * face + 1], c = triangles[3 * face + 2];
    if (std::max({a, b, c}) >= vertex_count)
      return problem(triangle_text(triangles, face) + " names a vertex that does not exist",
                     fmt::format("vertices below {}", vertex_count));
    if (a == b || b == c || c == a)
      return problem(triangle_text(triangles, face) + " has a vertex twice", "three different vertices");
  }
  return {};
}

// Stable counting sort of half-edges by `key(h)`, a vertex: linear whatever the valences are.
template <class Key>
Indices sorted_by_vertex(std::uint32_t vertex_count, const Indices& half_edges, Key key) {
  Indices place(std::size_t{vertex_count} + 1, 0), sorted(half_edges.size());
  for (const std::uint32_t h : half_edges) ++place[key(h) + 1];
  std::partial_sum(place.begin(), place.end(), place.begin());
  for (const std::uint32_t h : half_edges) sorted[place[key(h)]++] = h;
  return sorted;
}

// Finds the twins of all half-edges: sorted by larger and then by smaller vertex, those of one edge are adjacent.
Error match_twins(std::uint32_t vertex_count, const Indices& origin, Indices& twin, const VertexText& vertex_text) {
  const auto target = [&](std::uint32_t h) { return origin[HalfEdgeMesh::next(h)]; };
  const auto smaller = [&](std::uint32_t h) { return std::min(origin[h], target(h)); };
  const auto larger = [&](std::uint32_t h) { return std::max(origin[h], target(h)); };
  Indices order(origin.size());
  std::iota(order.begin(), order.end(), 0u);
  order = sorted_by_vertex(vertex_count, order, larger);
  order = sorted_by_vertex(vertex_count, order, smaller);

  for (std::size_t i = 0, end = 0; i < order.size(); i = end) {
    const std::uint32_t h = order[i];
    for (end = i + 1; end < order.size() && smaller(order[end]) == smaller(h) && larger(order[end]) == larger(h);)
      ++end;
    if (end - i == 1) continue;
    const std::uint32_t other = order[i + 1];
    if (end - i > 2)
      return problem(
          fmt::format("edge {} belongs to {} triangles, first {}", edge_text(smaller(h), larger(h), vertex_text),
                      end - i, triangle_text(origin, HalfEdgeMesh::face_of(h))),
          "at most two triangles at an edge");
    if (origin[h] == origin[other])
      return problem(fmt::format("{} and {} both run along edge {} in the same direction",
                                 triangle_text(origin, HalfEdgeMesh::face_of(h)),
                                 triangle_text(origin, HalfEdgeMesh::face_of(other)),
                                 edge_text(origin[h], target(h), vertex_text)),
                     "all triangles counter-clockwise from above");
    twin[h] = other, twin[other] = h;
  }
  return {};
}

}  // namespace

Result<HalfEdgeMesh> HalfEdgeMesh::build(std::uint32_t vertex_count, std::vector<std::uint32_t> triangles,
                                         const VertexText& vertex_text) {
  if (Error error = check_triangles(vertex_count, triangles); !error.problem.empty()) return fail(std::move(error));
  HalfEdgeMesh mesh;
  mesh.origin_ = std::move(triangles);
  Indices twin(mesh.origin_.size(), kNone), outgoing(vertex_count, kNone);
  Error error = match_twins(vertex_count, mesh.origin_, twin, vertex_text);
  if (!error.problem.empty()) return fail(std::move(error));

  // The lowest half-edge of each vertex, then those at a boundary; and how many there are.
  std::vector<std::uint32_t> valence(vertex_count, 0);
  for (std::uint32_t h = mesh.half_edge_count(); h-- > 0;) {
    outgoing[mesh.origin_[h]] = h;
    ++valence[mesh.origin_[h]];
  }
  for (std::uint32_t h = mesh.half_edge_count(); h-- > 0;)
    if (twin[h] == kNone) outgoing[mesh.origin_[h]] = h;
  mesh.twin_.assign(std::move(twin));
  mesh.outgoing_.assign(std::move(outgoing));

  // Rotation that misses a half-edge means a second fan.
  for (std::uint32_t v = 0; v < vertex_count; ++v) {
    std::uint32_t met = 0;
    mesh.for_each_outgoing(v, [&](std::uint32_t) { ++met; });
    if (met != valence[v])
      return fail(problem(fmt::format("only {} of the {} triangles at vertex {} are joined by edges, from {} on", met,
                                      valence[v], v, triangle_text(mesh.origin_, face_of(mesh.outgoing(v)))),
                          "one fan round each vertex; duplicate a vertex where two parts touch"));
  }
  return mesh;
}

HalfEdgeMesh HalfEdgeMesh::of_grid(const GridLayout& layout, std::vector<std::uint32_t> triangles) {
  DIVOT_ASSERT(triangles.size() == 6 * std::size_t{layout.cell_count()});
  HalfEdgeMesh mesh;
  mesh.origin_ = std::move(triangles);
  mesh.grid_ = layout;
  mesh.twin_.imply(mesh.origin_.size());
  mesh.outgoing_.imply(std::size_t{layout.columns} * layout.rows);
  return mesh;
}

std::string HalfEdgeMesh::validate() const {
  if (twin_.size() != origin_.size()) return fmt::format("{} twins for {} half-edges", twin_.size(), origin_.size());
  const Result<HalfEdgeMesh> fresh = build(vertex_count(), origin_);
  if (!fresh) return fresh.error().front().text();

  // The triangles make a surface, and twins and outgoing half-edges must be those of that surface.
  for (std::uint32_t h = 0; h < half_edge_count(); ++h)
    if (twin(h) != fresh->twin(h))
      return fmt::format("half-edge {} ({} to {}) has twin {} instead of {}", h, origin(h), target(h), twin(h),
                         fresh->twin(h));
  for (std::uint32_t v = 0; v < vertex_count(); ++v)
    if (outgoing(v) != fresh->outgoing(v))
      return fmt::format("vertex {} has outgoing half-edge {} instead of {}", v, outgoing(v), fresh->outgoing(v));
  return {};
}

}  // namespace divot::geometry
