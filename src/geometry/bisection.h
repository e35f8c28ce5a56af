#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/id_set.h"
#include "divot/ids.h"
#include "geometry/half_edge_mesh.h"

namespace divot::geometry {

/// How the faces of a mesh were halved since it was made, and so how they can be made whole again: for each face of the
/// base mesh a binary tree, which also finds what became of it. Faces are halved two at an edge, so that there is no
/// crack. Ids of vertices never change; those that went are used again.
class Bisection {
 public:
  /// The mesh as it stands is the base. Before that, nothing may be split. [O(faces)]
  void start(const HalfEdgeMesh& mesh);
  bool started() const { return base_vertices_ != kNone; }
  /// Is any face halved?
  bool any() const { return count_ > 0; }
  std::uint32_t added_count() const { return count_; }  ///< vertices that the mesh has beyond its base
  std::uint32_t base_vertex_count() const { return base_vertices_; }
  std::uint32_t base_face_count() const { return base_faces_; }

  /// HalfEdgeMesh::split_edge, remembered. [O(valence)]
  std::uint32_t split(HalfEdgeMesh& mesh, std::uint32_t h);

  /// Could the vertex go? So it is where all its neighbours were there before it did. [O(valence)]
  bool can_merge(const HalfEdgeMesh& mesh, std::uint32_t vertex) const;
  /// Undoes the split that made a vertex; can_merge must hold. It stays behind without faces. [O(valence)]
  void merge(HalfEdgeMesh& mesh, std::uint32_t vertex);

  /// Ends of the edge that an added vertex was put on. [O(1)]
  std::array<std::uint32_t, 2> parents(std::uint32_t vertex) const { return birth_[vertex - base_vertices_].parents; }
  /// 0 for vertices of the base, else one more than the highest around it when it was made. [O(1)]
  std::uint32_t generation(std::uint32_t vertex) const {
    return vertex < base_vertices_ ? 0 : birth_[vertex - base_vertices_].generation;
  }

  /// The face of the base mesh that a face is a part of: it has that face's id or a later one. [O(generation)]
  std::uint32_t base_of(std::uint32_t face) const;
  /// Corners of a face of the base mesh as it was before it was halved. [O(generation)]
  std::array<std::uint32_t, 3> base_corners(const HalfEdgeMesh& mesh, std::uint32_t base) const;

  /// Calls f(face) for the parts of a face of the base mesh, skipping parts that `meets`, which is asked with their
  /// corners, says no to.
  template <class Meets, class F>
  void for_each_part(std::uint32_t base, Meets meets, F f) const {
    if (leaf_[base] == kNone) return f(base);
    visit(root_of(leaf_[base]), meets, f);
  }

  /// A face that is there or was halved. For those who keep the state of a world.
  struct Node {
    std::array<std::uint32_t, 3> corner{};                // of a face that was halved
    std::array<std::uint32_t, 2> child = {kNone, kNone};  // second one of a face that is there: the face
    std::uint32_t parent = kNone;
    bool is_face() const { return child[0] == kNone; }
  };
  /// Where an added vertex came from.
  struct Birth {
    std::array<std::uint32_t, 2> parents = {kNone, kNone};
    std::uint32_t generation = 0;
  };
  /// Calls f(value) for everything this consists of but changed(), for bytes and back. Afterwards fits() says whether
  /// it can be.
  template <class F>
  void for_each_value(F f) {
    f(base_vertices_), f(base_faces_), f(count_), f(birth_), f(free_vertex_), f(nodes_), f(free_node_), f(leaf_);
  }
  template <class F>
  void for_each_value(F f) const {
    f(base_vertices_), f(base_faces_), f(count_), f(birth_), f(free_vertex_), f(nodes_), f(free_node_), f(leaf_);
  }
  /// Does nothing lead out of an array, and every tree to its end, for this mesh? [O(faces)]
  bool fits(const HalfEdgeMesh& mesh) const;

  /// Faces that have other corners than when this was last emptied, or none.
  core::IdSet& changed() { return changed_; }

 private:
  std::uint32_t root_of(std::uint32_t node) const {
    while (nodes_[node].parent != kNone) node = nodes_[node].parent;
    return node;
  }
  std::uint32_t make_node(const Node& node);
  void halve(std::uint32_t face, const std::array<std::uint32_t, 3>& corner, std::uint32_t other);
  void join(std::uint32_t face, std::uint32_t other);
  template <class Meets, class F>
  void visit(std::uint32_t node, Meets& meets, F& f) const {
    const Node& n = nodes_[node];
    if (n.is_face()) return f(n.child[1]);
    if (!meets(n.corner)) return;
    visit(n.child[0], meets, f);
    visit(n.child[1], meets, f);
  }

  std::uint32_t base_vertices_ = kNone, base_faces_ = 0, count_ = 0;
  std::vector<Birth> birth_;                // [vertex - base_vertices]
  std::vector<std::uint32_t> free_vertex_;  // without faces, to be used again: the last first
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> free_node_;
  std::vector<std::uint32_t> leaf_;  // [face] its node; kNone for a face of the base that is whole
  core::IdSet changed_;
};

/// The longest side of a face: its half-edge, where `squared(h)` is the square of an edge's length, the same for both
/// of its half-edges. Of equal ones the one whose vertices are the higher, so that two faces agree on it.
template <class Squared>
std::uint32_t longest_side(const HalfEdgeMesh& mesh, std::uint32_t face, Squared squared) {
  std::uint32_t longest = 3 * face;
  double most = squared(longest);
  const auto higher = [&](std::uint32_t h, std::uint32_t g) {
    const auto ends = [&](std::uint32_t e) {
      const std::uint32_t a = mesh.origin(e), b = mesh.target(e);
      return a < b ? std::array{b, a} : std::array{a, b};
    };
    return ends(h) > ends(g);
  };
  for (std::uint32_t h = 3 * face + 1; h < 3 * face + 3; ++h) {
    const double length = squared(h);
    if (length > most || (length == most && higher(h, longest))) longest = h, most = length;
  }
  return longest;
}

/// Where halving a face has to begin for the mesh to stay without cracks and its angles to stay wide: from face to face
/// over the longest sides to an edge that is the longest on both of its sides [Rivara 1984]. Angles are never less than
/// half of the base's; those of right triangles with equal legs stay as they are. [O(path)]
template <class Squared>
std::uint32_t longest_ahead(const HalfEdgeMesh& mesh, std::uint32_t face, Squared squared) {
  for (std::uint32_t h = longest_side(mesh, face, squared);;) {
    const std::uint32_t across = mesh.twin(h);
    if (across == kNone) return h;
    const std::uint32_t next = longest_side(mesh, HalfEdgeMesh::face_of(across), squared);
    if (next == across) return h;
    h = next;
  }
}

}  // namespace divot::geometry
