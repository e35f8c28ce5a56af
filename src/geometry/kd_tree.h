#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "divot/jobs.h"
#include "geometry/row_gatherer.h"
#include "geometry/rows.h"

namespace divot::geometry {

/// Neighbours by a kd-tree (nanoflann), as in [Dvorak & Drahansky 2008]. Gives the rows that ColumnGrid gives, for
/// particles that do not lie in a sheet too, at several times the cost.
class KdTree {
 public:
  KdTree();
  ~KdTree();
  KdTree(KdTree&&) noexcept;
  KdTree& operator=(KdTree&&) noexcept;

  /// Builds the tree over particles at x, y, z ([particle] m, finite). The spans must stay valid and unchanged until
  /// the last rows(). nanoflann allocates its nodes anew each time. [O(particles log particles)]
  void build(std::span<const float> x, std::span<const float> y, std::span<const float> z);

  /// Writes the neighbours of every particle within `radius` (m, >= 0, its square finite). Bits do not depend on the
  /// number of threads. [O(particles log particles + pairs)]
  void rows(float radius, Rows& rows, const Jobs& jobs);

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
  RowGatherer gatherer_;
};

}  // namespace divot::geometry
