#include "geometry/kd_tree.h"

#include <array>
#include <limits>
#include <nanoflann.hpp>

#include "core/assert.h"
#include "divot/ids.h"

namespace divot::geometry {
namespace {

// The particles as nanoflann wants to see them.
struct Points {
  std::span<const float> x, y, z;

  std::size_t kdtree_get_point_count() const { return x.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const { return axis == 0 ? x[i] : axis == 1 ? y[i] : z[i]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;  // let nanoflann find it
  }
};

// Takes what nanoflann offers within a slightly larger radius and keeps what is in by the distance of Rows.
class RowSet {
 public:
  using DistanceType = float;

  RowSet(const Points& points, std::uint32_t i, float radius_squared, RowChunk& chunk)
      : points_(points), i_(i), radius_squared_(radius_squared), chunk_(chunk) {}

  bool addPoint(float, std::uint32_t j) {
    const float dx = points_.x[j] - points_.x[i_], dy = points_.y[j] - points_.y[i_], dz = points_.z[j] - points_.z[i_];
    if (j != i_ && (dx * dx + dy * dy) + dz * dz <= radius_squared_) chunk_.room(found_ + 1)[found_] = j, ++found_;
    return true;  // go on
  }
  // nanoflann sums in another order and wants less than, not at most; the smallest float lets radius 0 work.
  float worstDist() const { return radius_squared_ * (1 + 1e-5f) + std::numeric_limits<float>::min(); }
  bool full() const { return true; }
  std::size_t size() const { return found_; }

 private:
  const Points& points_;
  std::uint32_t i_;
  float radius_squared_;
  RowChunk& chunk_;
  std::size_t found_ = 0;
};

}  // namespace

struct KdTree::Tree {
  using Index =
      nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 3, std::uint32_t>;

  explicit Tree(const Points& p) : points(p), index(3, points, {kLeafPoints}) {
    if (!points.x.empty()) index.buildIndex();
  }

  static constexpr std::size_t kLeafPoints = 10;  // nanoflann's own default
  Points points;
  Index index;
};

KdTree::KdTree() = default;
KdTree::~KdTree() = default;
KdTree::KdTree(KdTree&&) noexcept = default;
KdTree& KdTree::operator=(KdTree&&) noexcept = default;

void KdTree::build(std::span<const float> x, std::span<const float> y, std::span<const float> z) {
  DIVOT_ASSERT(x.size() == y.size() && x.size() == z.size() && x.size() < kNone);
  tree_ = std::make_unique<Tree>(Points{x, y, z});
}

void KdTree::rows(float radius, Rows& rows, const Jobs& jobs) {
  DIVOT_ASSERT(radius >= 0);
  const float radius_squared = radius * radius;
  const auto find = [&](std::size_t i, RowChunk& chunk) {
    const Points& points = tree_->points;
    const std::array<float, 3> centre{points.x[i], points.y[i], points.z[i]};
    RowSet row(points, static_cast<std::uint32_t>(i), radius_squared, chunk);
    tree_->index.findNeighbors(row, centre.data(), {});
    return row.size();
  };
  gatherer_.gather(tree_ ? tree_->points.x.size() : 0, jobs, find, rows);
}

}  // namespace divot::geometry
