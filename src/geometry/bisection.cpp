#include "geometry/bisection.h"

#include <algorithm>

#include "core/assert.h"

namespace divot::geometry {
namespace {

std::array<std::uint32_t, 3> corners_of(const HalfEdgeMesh& mesh, std::uint32_t face) {
  return {mesh.origin(3 * face), mesh.origin(3 * face + 1), mesh.origin(3 * face + 2)};
}

// The half-edge that ends at `vertex` and starts at `from`.
std::uint32_t half_edge_to(const HalfEdgeMesh& mesh, std::uint32_t from, std::uint32_t vertex) {
  std::uint32_t found = kNone;
  mesh.for_each_outgoing(vertex, [&](std::uint32_t h) {
    if (mesh.origin(HalfEdgeMesh::prev(h)) == from) found = HalfEdgeMesh::prev(h);
  });
  return found;
}

}  // namespace

void Bisection::start(const HalfEdgeMesh& mesh) {
  *this = {};
  base_vertices_ = mesh.vertex_count();
  base_faces_ = mesh.face_count();
  leaf_.assign(base_faces_, kNone);
}

std::uint32_t Bisection::make_node(const Node& node) {
  if (free_node_.empty()) {
    nodes_.push_back(node);
    return static_cast<std::uint32_t>(nodes_.size() - 1);
  }
  const std::uint32_t index = free_node_.back();
  free_node_.pop_back();
  nodes_[index] = node;
  return index;
}

void Bisection::halve(std::uint32_t face, const std::array<std::uint32_t, 3>& corner, std::uint32_t other) {
  if (leaf_[face] == kNone) leaf_[face] = make_node({});
  const std::uint32_t node = leaf_[face];
  const std::uint32_t first = make_node({.child = {kNone, face}, .parent = node});
  const std::uint32_t second = make_node({.child = {kNone, other}, .parent = node});
  nodes_[node].corner = corner;
  nodes_[node].child = {first, second};
  leaf_[face] = first;
  DIVOT_ASSERT(other == leaf_.size());
  leaf_.push_back(second);
  changed_.insert(face), changed_.insert(other);
}

void Bisection::join(std::uint32_t face, std::uint32_t other) {
  const std::uint32_t node = nodes_[leaf_[face]].parent;
  DIVOT_ASSERT(node != kNone && nodes_[leaf_[other]].parent == node);
  free_node_.insert(free_node_.end(), {leaf_[face], leaf_[other]});
  const bool whole = nodes_[node].parent == kNone;
  if (whole) free_node_.push_back(node);
  nodes_[node].child = {kNone, face};
  leaf_[face] = whole ? kNone : node;
  changed_.insert(face), changed_.insert(other);
}

std::uint32_t Bisection::split(HalfEdgeMesh& mesh, std::uint32_t h) {
  const std::uint32_t g = mesh.twin(h), face = HalfEdgeMesh::face_of(h);
  const std::array<std::uint32_t, 3> corner = corners_of(mesh, face);
  const std::uint32_t across = g == kNone ? kNone : HalfEdgeMesh::face_of(g);
  const std::array<std::uint32_t, 3> corner_across = g == kNone ? corner : corners_of(mesh, across);
  Birth birth{{mesh.origin(h), mesh.target(h)}, 0};
  for (const auto& corners : {corner, corner_across})
    for (const std::uint32_t v : corners) birth.generation = std::max(birth.generation, generation(v) + 1);

  std::uint32_t vertex = kNone;
  if (!free_vertex_.empty()) vertex = free_vertex_.back(), free_vertex_.pop_back();
  vertex = mesh.split_edge(h, vertex);
  if (birth_.size() <= vertex - base_vertices_) birth_.resize(vertex - base_vertices_ + 1);
  birth_[vertex - base_vertices_] = birth;
  halve(face, corner, mesh.face_count() - (g == kNone ? 1 : 2));
  if (g != kNone) halve(across, corner_across, mesh.face_count() - 1);
  ++count_;
  return vertex;
}

bool Bisection::can_merge(const HalfEdgeMesh& mesh, std::uint32_t vertex) const {
  if (vertex < base_vertices_ || mesh.outgoing(vertex) == kNone) return false;
  const std::uint32_t own = generation(vertex);
  bool last = true;
  std::uint32_t count = 0;
  mesh.for_each_neighbour(vertex, [&](std::uint32_t u) { last &= generation(u) < own, ++count; });
  return last && count == (mesh.is_boundary(vertex) ? 3u : 4u);
}

void Bisection::merge(HalfEdgeMesh& mesh, std::uint32_t vertex) {
  const std::uint32_t h = half_edge_to(mesh, parents(vertex)[0], vertex);
  // What is joined to the face on the left of h and to that on the left of the half-edge which meets it.
  const auto beside = [&](std::uint32_t kept) { return mesh.twin(HalfEdgeMesh::next(kept)); };
  const std::uint32_t g = mesh.twin(HalfEdgeMesh::next(beside(h)));
  join(HalfEdgeMesh::face_of(h), HalfEdgeMesh::face_of(beside(h)));
  if (g != kNone) join(HalfEdgeMesh::face_of(g), HalfEdgeMesh::face_of(beside(g)));
  for (const auto& [place, last] : mesh.unsplit_edge(h)) {
    if (place == kNone) continue;
    leaf_[place] = leaf_[last];
    if (place != last && leaf_[place] != kNone) nodes_[leaf_[place]].child[1] = place;
    leaf_.pop_back();
    changed_.insert(place), changed_.insert(last);
  }
  free_vertex_.push_back(vertex);
  --count_;
}

std::uint32_t Bisection::base_of(std::uint32_t face) const {
  if (leaf_[face] == kNone) return face;
  // The first part always keeps the id.
  std::uint32_t node = root_of(leaf_[face]);
  while (!nodes_[node].is_face()) node = nodes_[node].child[0];
  return nodes_[node].child[1];
}

std::array<std::uint32_t, 3> Bisection::base_corners(const HalfEdgeMesh& mesh, std::uint32_t base) const {
  return leaf_[base] == kNone ? corners_of(mesh, base) : nodes_[root_of(leaf_[base])].corner;
}

bool Bisection::fits(const HalfEdgeMesh& mesh) const {
  constexpr int kDeepest = 256;
  const std::size_t vertices = mesh.vertex_count(), nodes = nodes_.size();
  const auto below = [](const std::vector<std::uint32_t>& ids, std::size_t end) {
    return std::ranges::all_of(ids, [&](std::uint32_t id) { return id < end; });
  };
  if (base_vertices_ > vertices || base_faces_ > mesh.face_count() || leaf_.size() != mesh.face_count() ||
      birth_.size() != vertices - base_vertices_ || !below(free_node_, nodes))
    return false;
  const auto is_gone = [&](std::uint32_t v) {
    return v >= base_vertices_ && v < vertices && mesh.outgoing(v) == kNone;
  };
  if (!std::ranges::all_of(free_vertex_, is_gone) || count_ + free_vertex_.size() != birth_.size()) return false;
  for (const Birth& birth : birth_)
    if (birth.parents[0] >= vertices || birth.parents[1] >= vertices) return false;
  const auto has_child = [&](std::uint32_t node, std::uint32_t child) {
    const Node& n = nodes_[node];
    return !n.is_face() && n.child[0] < nodes && n.child[1] < nodes && (n.child[0] == child || n.child[1] == child) &&
           std::ranges::all_of(n.corner, [&](std::uint32_t v) { return v < vertices; });
  };
  for (std::uint32_t face = 0; face < leaf_.size(); ++face) {
    std::uint32_t node = leaf_[face];
    if (node == kNone) {
      if (face >= base_faces_) return false;
      continue;
    }
    if (node >= nodes || !nodes_[node].is_face() || nodes_[node].child[1] != face) return false;
    for (int depth = 0; nodes_[node].parent != kNone; ++depth) {
      const std::uint32_t parent = nodes_[node].parent;
      if (depth == kDeepest || parent >= nodes || !has_child(parent, node)) return false;
      node = parent;
    }
  }
  return true;
}

}  // namespace divot::geometry
