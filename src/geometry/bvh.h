#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
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
///
/// Eight faces make a leaf, eight leaves a node, eight nodes the next: which is below which follows from the order of
/// the faces alone, and the tree is its boxes, eight side by side, 7 bytes a vertex.
class Bvh {
 public:
  /// Faces in a leaf, the last leaf excepted.
  static constexpr std::uint32_t kLeafFaces = 8;

  /// Vertex ids of a face's corners.
  using Corners = std::function<std::array<std::uint32_t, 3>(std::uint32_t face)>;
  /// Which faces make a leaf: those whose ids follow each other, for surfaces numbered so that these are near each
  /// other, or those that lie together, which takes 16 bytes a vertex more.
  enum class Order : std::uint8_t { as_numbered, by_place };

  /// Makes the tree anew for faces [0, face_count) at `positions` ([vertex] m, finite) with boxes larger by `margin`
  /// (m, >= 0). The same tree for any number of threads. [O(faces), by place O(faces log faces)]
  void build(std::uint32_t face_count, const Corners& corners, std::span<const Vec3> positions, float margin,
             Order order, const Jobs& jobs);

  std::size_t face_count() const { return face_count_; }

  /// To be called for each face with a corner that moved, which is now at `corner`. True when it has left the box of
  /// its leaf, which is then refitted by the next refit(); until then queries may miss it. [O(1)]
  bool touch(std::uint32_t face, const Vec3& corner);

  /// Faces of one leaf need one touch() for a corner they share.
  std::uint32_t leaf_of(std::uint32_t face) const { return leaf_of_.empty() ? face / kLeafFaces : leaf_of_[face]; }

  /// Recomputes, margin included, the leaves that touch() has found and as much above them as changes. Returns the
  /// number of boxes that changed. [O(touched leaves * log faces)]
  std::size_t refit(const Corners& corners, std::span<const Vec3> positions);

  /// Recomputes every box. [O(faces)]
  void refit_all(const Corners& corners, std::span<const Vec3> positions, const Jobs& jobs);

  /// Sum of the surface areas of all boxes, relative to what it was after build(): 1 then, larger when queries have
  /// become slower.
  float degradation() const;

  /// The boxes of the nodes at a level, that of the whole being 0: none below the leaves. [O(boxes found)]
  std::vector<math::Aabb> boxes(int level) const;

  /// Appends the faces whose leaf's box overlaps `box`: all that truly do and some nearby. What is appended is in
  /// ascending order, whatever the tree has been through. [O(log faces + found)]
  void query(const math::Aabb& box, std::vector<std::uint32_t>& faces) const;
  /// The same for a ball round `center` of `radius` (m, >= 0).
  void query_sphere(const Vec3& center, float radius, std::vector<std::uint32_t>& faces) const;

 private:
  static constexpr std::uint32_t kWide = 8;
  static constexpr std::uint32_t kMostLevels = 11;
  // The boxes of eight leaves or nodes, by axis: those beyond the last are empty.
  struct alignas(64) Eight {
    std::array<std::array<float, kWide>, 3> low, high;
    Eight();
    math::Aabb box(std::uint32_t k) const;
    void set(std::uint32_t k, const math::Aabb& box);
    math::Aabb all() const;
  };
  // Boxes of one depth, the leaves' first: box i is in blocks_[first + i / 8] and lies round block i of the level
  // before, or round leaf i.
  struct Level {
    std::uint32_t first = 0, count = 0;
  };
  // A face while the tree is built by place.
  struct Item {
    std::array<float, 3> centre;
    std::uint32_t face;
  };
  // Leaves while the tree is built by place.
  struct Part {
    std::uint32_t first_leaf = 0, leaf_count = 0;
  };

  std::uint32_t face_at(std::size_t slot) const {
    return faces_.empty() ? static_cast<std::uint32_t>(slot) : faces_[slot];
  }
  std::size_t leaf_end(std::uint32_t leaf) const;
  math::Aabb box_of(std::uint32_t level, std::uint32_t index) const;
  math::Aabb fresh_box(std::uint32_t level, std::uint32_t index, const Corners& corners,
                       std::span<const Vec3> positions) const;
  bool mark(std::uint32_t level, std::uint32_t index);
  void lay_out_levels();
  void order_by_place(const Corners& corners, std::span<const Vec3> positions, const Jobs& jobs);
  std::array<Part, 2> split(const Part& part);
  void split_all(const Part& part);
  void fill_leaves(std::size_t begin, std::size_t end);
  template <class Hit>
  void collect(const Hit& hit, std::vector<std::uint32_t>& faces) const;

  std::size_t face_count_ = 0;
  std::array<Level, kMostLevels> level_{};
  std::uint32_t levels_ = 0;
  std::vector<Eight> blocks_;           // level by level
  std::vector<std::uint8_t> dirty_;     // [block] a bit for each box that is to be recomputed
  std::vector<std::uint32_t> faces_;    // [slot] face; leaf i has the slots from i * kLeafFaces. Empty as numbered
  std::vector<std::uint32_t> leaf_of_;  // [face] its leaf. Empty as numbered
  std::vector<std::uint32_t> touched_;  // leaves whose bit is set, in the order of touch()
  std::vector<std::uint32_t> upwards_;  // scratch of refit
  std::vector<Item> items_;             // scratch of build
  std::vector<Part> parts_, child_parts_;
  float margin_ = 0;
  double area_ = 0, built_area_ = 0;  // sums of half areas, m^2
};

/// The corners in an index buffer ([3 * face] vertex ids), which has to stay where it is.
inline Bvh::Corners corners_in(std::span<const std::uint32_t> triangles) {
  return [corner = triangles.data()](std::uint32_t face) {
    const std::size_t k = 3 * std::size_t{face};
    return std::array{corner[k], corner[k + 1], corner[k + 2]};
  };
}

}  // namespace divot::geometry
