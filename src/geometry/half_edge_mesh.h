#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "divot/errors.h"
#include "divot/ids.h"
#include "geometry/grid_layout.h"
#include "geometry/paged_ids.h"

namespace divot::geometry {

/// Connectivity of a triangle surface: which faces and vertices meet, not where they lie.
///
/// Half-edge h belongs to face h / 3 and the three of a face follow each other counter-clockwise seen from above, so
/// that next and previous need no storage and the array of origins is the index buffer. Edges have one face (boundary)
/// or two; the faces round a vertex form one fan. Vertices without a face are allowed: they are holes in the data.
///
/// Twins and outgoing half-edges depend on the triangles alone, never on the edits that led to them, so a saved mesh
/// is its triangles: build() gives back the same walking order.
///
/// On a grid they follow from its numbering, and are stored only round where triangles were edited.
class HalfEdgeMesh {
 public:
  /// No vertices and no faces.
  HalfEdgeMesh() = default;

  /// Connects `triangles` ([3 * face] vertex ids below `vertex_count`). Fails, naming the first offender, on an index
  /// out of range, a triangle with a vertex twice, an edge with more than two faces or two that disagree about its
  /// direction, and a vertex where two fans touch. [O(vertices + faces)]
  /// `vertex_text` says what errors call the ends of a bad edge; empty: their ids.
  static Result<HalfEdgeMesh> build(std::uint32_t vertex_count, std::vector<std::uint32_t> triangles,
                                    const std::function<std::string(std::uint32_t)>& vertex_text = {});

  /// The same for the `triangles` of a grid without holes, numbered as GridLayout says. [O(1)]
  static HalfEdgeMesh of_grid(const GridLayout& layout, std::vector<std::uint32_t> triangles);

  /// Memory for a mesh of so many: edits up to there leave triangles() where it is.
  void reserve(std::size_t vertices, std::size_t faces);

  std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(outgoing_.size()); }
  std::uint32_t face_count() const { return half_edge_count() / 3; }
  std::uint32_t half_edge_count() const { return static_cast<std::uint32_t>(origin_.size()); }
  /// [3 * face] vertex ids, counter-clockwise from above. Valid until the next edit.
  std::span<const std::uint32_t> triangles() const { return origin_; }

  /// The half-edge after `h` in its face.
  static std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  /// The half-edge before `h` in its face.
  static std::uint32_t prev(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  static std::uint32_t face_of(std::uint32_t h) { return h / 3; }

  /// Vertex where `h` starts.
  std::uint32_t origin(std::uint32_t h) const { return origin_[h]; }
  /// Vertex where `h` ends.
  std::uint32_t target(std::uint32_t h) const { return origin_[next(h)]; }
  /// The same edge seen from the face on its other side; kNone at a boundary.
  std::uint32_t twin(std::uint32_t h) const { return twin_.follows_rule(h) ? grid_.twin(h) : twin_[h]; }
  /// A half-edge that starts at `v`: the boundary one of a vertex at the boundary (counter-clockwise rotation from it
  /// meets the whole fan), else the lowest; kNone for a vertex without faces.
  std::uint32_t outgoing(std::uint32_t v) const { return outgoing_.follows_rule(v) ? grid_.outgoing(v) : outgoing_[v]; }
  /// Has faces, but not all the way round. [O(1)]
  bool is_boundary(std::uint32_t v) const {
    if (outgoing_.follows_rule(v)) return grid_.is_border(grid_.node(v));
    return outgoing(v) != kNone && twin(outgoing(v)) == kNone;
  }

  /// Calls `f(vertex)` once for each vertex that shares an edge with `v`, counter-clockwise. [O(valence)]
  template <class F>
  void for_each_neighbour(std::uint32_t v, F&& f) const {
    const Fan fan = implied_fan(v);
    walk(v, fan, [&](std::uint32_t h) {
      f(target(h));
      // The far end of an open fan has no half-edge from v.
      if (fan.count == 0 && twin(prev(h)) == kNone) f(origin_[prev(h)]);
    });
  }

  /// Calls `f(face)` once for each face round `v`, counter-clockwise. [O(valence)]
  template <class F>
  void for_each_face(std::uint32_t v, F&& f) const {
    for_each_outgoing(v, [&](std::uint32_t h) { f(face_of(h)); });
  }

  /// Calls `f(half_edge)` once for each half-edge that starts at `v`, counter-clockwise. [O(valence)]
  template <class F>
  void for_each_outgoing(std::uint32_t v, F&& f) const {
    walk(v, implied_fan(v), f);
  }

  /// Puts a new vertex in the middle of the edge of `h` and returns it: it is the last, or `vertex`, one without faces;
  /// `h` now ends there; prev(h) keeps its edge. One face at a boundary becomes two, two become four; the new faces are
  /// the last. [O(valence)]
  std::uint32_t split_edge(std::uint32_t h, std::uint32_t vertex = kNone);

  /// A face that is gone and the one that has taken its place, the last; the same where it was the last itself.
  struct Moved {
    std::uint32_t place = kNone, last = kNone;  ///< kNone: none is gone
  };
  /// Undoes split_edge: the target of `h`, which nothing else may have been joined to since, stays behind without
  /// faces. The faces on the left of `h` and of the half-edge that meets it in that vertex are whole again; the other
  /// one or two are gone, in the order told. [O(valence)]
  std::array<Moved, 2> unsplit_edge(std::uint32_t h);

  /// Turns the edge between two faces into the other diagonal of their quad; `h` stays the half-edge of that edge.
  /// False, and nothing changes, at a boundary or where the other diagonal is an edge already. Whether the quad is
  /// convex is for the caller, who knows where the vertices lie. [O(valence)]
  bool flip_edge(std::uint32_t h);

  /// Merges the target of `h` into its origin and removes the edge's faces; the last faces move into their places and
  /// the target stays behind as a vertex without faces. False, and nothing changes, where the result would not be a
  /// surface any more (link condition). Whether faces turn over is for the caller. [O(valence^2)]
  bool collapse_edge(std::uint32_t h);

  /// Empty when every promise of this class holds, else the first broken one in words. [O(vertices + faces)]
  std::string validate() const;

 private:
  using Fan = GridLayout::Fan;
  // The fan of a vertex inside a grid, nothing elsewhere. Edits write outgoing() of each vertex whose fan they change:
  // where that follows the rule, all of the fan does.
  Fan implied_fan(std::uint32_t v) const {
    if (!outgoing_.follows_rule(v)) return {};
    const GridLayout::Node at = grid_.node(v);
    return grid_.is_border(at) ? Fan{} : grid_.fan(at);
  }
  template <class F>
  void walk(std::uint32_t v, const Fan& fan, F&& f) const {
    // One call of f in here: what it does is inlined where it is called.
    const std::uint32_t first = fan.count > 0 ? fan.half_edge[0] : outgoing(v);
    for (std::uint32_t h = first, met = 1; h != kNone; ++met) {
      f(h);
      if (fan.count > 0)
        h = met < fan.count ? fan.half_edge[met] : kNone;
      else if (h = twin(prev(h)); h == first)
        break;
    }
  }
  void set_twin(std::uint32_t h, std::uint32_t twin);
  void set_outgoing(std::uint32_t v, std::uint32_t h);
  void link(std::uint32_t a, std::uint32_t b);
  std::uint32_t split_face(std::uint32_t h, std::uint32_t vertex);
  bool can_collapse(std::uint32_t h) const;
  void close_face(std::uint32_t h);
  std::array<std::uint32_t, 3> remove_face(std::uint32_t face);
  bool are_neighbours(std::uint32_t a, std::uint32_t b) const;
  void settle_outgoing(std::uint32_t v, std::uint32_t h);

  std::vector<std::uint32_t> origin_;  // [half_edge] vertex where it starts: the index buffer
  PagedIds twin_;                      // [half_edge] kNone at a boundary
  PagedIds outgoing_;                  // [vertex] see outgoing()
  GridLayout grid_;                    // the rule of both
};

}  // namespace divot::geometry
