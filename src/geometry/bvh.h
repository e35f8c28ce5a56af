#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "divot/ids.h"
#include "divot/jobs.h"
#include "divot/vec.h"
#include "math/aabb.h"

namespace divot::geometry {

/// Bounding volume hierarchy over the faces of a surface that moves a little at a time. Boxes of leaves are larger than
/// their faces by a margin, so that most moves change nothing; the few that do are refitted alone, and degradation()
/// says when a new build pays. One thread at a time may call what is not const. The first build gives back what it
/// needed to build; from the second on vectors keep their capacity and nothing allocates.
class Bvh {
 public:
  /// Faces in a leaf, the last leaf excepted. Measured on 10^6 faces with balls half an edge in radius: 2, 4 and 8
  /// answer 0.52, 0.60 and 0.75 million queries a second with 14, 21 and 30 faces each, which the caller then has to
  /// look at; 8 takes half the memory of 4.
  static constexpr std::uint32_t kLeafFaces = 8;

  /// Makes the tree anew from `triangles` ([3 * face] vertex ids, copied) at `positions` ([vertex] m, finite) with
  /// boxes larger by `margin` (m, >= 0). The same tree for any number of threads. [O(faces log faces)]
  void build(std::span<const std::uint32_t> triangles, std::span<const Vec3> positions, float margin, const Jobs& jobs);

  std::size_t face_count() const { return faces_.size(); }

  /// To be called for each face with a vertex that moved. True when it has left the box of its leaf, which is then
  /// refitted by the next refit(); until then queries may miss it. [O(1)]
  bool touch(std::uint32_t face, std::span<const Vec3> positions);

  /// Recomputes, margin included, the leaves that touch() has found and as much above them as changes. Returns the
  /// number of nodes whose box changed. [O(touched leaves * log faces)]
  std::size_t refit(std::span<const Vec3> positions);

  /// Recomputes every box. [O(faces)]
  void refit_all(std::span<const Vec3> positions);

  /// Sum of the surface areas of all boxes, relative to what it was after build(): 1 then, larger when queries have
  /// become slower.
  float degradation() const;

  /// The boxes of the nodes at a level, the root's being 0: none below the deepest. [O(nodes)]
  std::vector<math::Aabb> boxes(int level) const;

  /// Appends the faces whose leaf's box overlaps `box`: all that truly do and some nearby. What is appended is in
  /// ascending order, whatever the tree has been through. [O(log faces + found)]
  void query(const math::Aabb& box, std::vector<std::uint32_t>& faces) const;
  /// The same for a ball round `center` of `radius` (m, >= 0).
  void query_sphere(const Vec3& center, float radius, std::vector<std::uint32_t>& faces) const;

 private:
  // Nodes lie in depth-first order: the first child follows its parent, and `skip` is the first node that is not below
  // this one, which makes a query one loop without a stack.
  struct Node {
    math::Aabb box;
    std::uint32_t skip = 0;
    std::uint32_t leaf = kNone;  // index of the leaf, kNone for an inner node
  };
  // A face while the tree is built.
  struct Item {
    std::array<float, 3> centre;
    std::uint32_t face;
  };
  // A node while the tree is built, and the leaves below it.
  struct Part {
    std::uint32_t node = 0, first_leaf = 0, leaf_count = 0;
  };

  std::uint32_t leaf_count() const { return static_cast<std::uint32_t>(leaf_node_.size()); }
  std::span<const std::uint32_t> leaf_corners(std::uint32_t leaf) const;
  std::size_t leaf_end(std::uint32_t leaf) const;
  std::array<Part, 2> split(const Part& part);
  void split_all(const Part& part);
  void fill_leaves(std::span<const std::uint32_t> triangles, std::size_t begin, std::size_t end);
  math::Aabb fresh_box(std::uint32_t node, std::span<const Vec3> positions) const;
  bool update(std::uint32_t node, std::span<const Vec3> positions);
  std::size_t refit_by_heap(std::span<const Vec3> positions);
  std::size_t refit_by_scan(std::span<const Vec3> positions);
  template <class Hit>
  void collect(const Hit& hit, std::vector<std::uint32_t>& faces) const;

  std::vector<Node> nodes_;               // [node] depth-first
  std::vector<std::uint32_t> parent_;     // [node] kNone for the root
  std::vector<std::uint32_t> leaf_node_;  // [leaf] its node
  std::vector<std::uint32_t> faces_;      // [slot] face; leaf i has the slots from i * kLeafFaces
  std::vector<std::uint32_t> corners_;    // [3 * slot] vertices of that face
  std::vector<std::uint32_t> leaf_of_;    // [face] its leaf
  std::vector<std::uint8_t> dirty_;       // [node] 1: to be recomputed
  std::vector<std::uint32_t> heap_;       // dirty nodes; those that touch() found, and while refitting a heap
  std::vector<Item> items_;               // scratch of build
  std::vector<Part> parts_, child_parts_;
  float margin_ = 0;
  double area_ = 0, built_area_ = 0;  // sums of half areas, m^2
};

}  // namespace divot::geometry
