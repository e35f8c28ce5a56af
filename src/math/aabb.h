#pragma once

#include <algorithm>
#include <limits>

#include "divot/vec.h"

namespace divot::math {

/// Axis-aligned box; empty by default, and an empty one touches nothing.
struct Aabb {
  Vec3 low{kInf, kInf, kInf}, high{-kInf, -kInf, -kInf};
  static constexpr float kInf = std::numeric_limits<float>::infinity();

  void include(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  void include(const Aabb& b) {
    low = {std::min(low.x, b.low.x), std::min(low.y, b.low.y), std::min(low.z, b.low.z)};
    high = {std::max(high.x, b.high.x), std::max(high.y, b.high.y), std::max(high.z, b.high.z)};
  }
  void grow(float margin) {
    low -= Vec3{margin, margin, margin};
    high += Vec3{margin, margin, margin};
  }
  bool contains(const Vec3& p) const {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z && p.z <= high.z;
  }
  bool overlaps(const Aabb& b) const {
    return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y && low.z <= b.high.z &&
           b.low.z <= high.z;
  }
  /// Half the surface area, m^2; 0 when empty.
  float half_area() const {
    if (!(low.x <= high.x)) return 0;
    const Vec3 d = high - low;
    return d.x * d.y + d.y * d.z + d.z * d.x;
  }
  /// Squared distance from a point, 0 inside.
  float distance_squared(const Vec3& p) const {
    const Vec3 d{std::max({low.x - p.x, 0.0f, p.x - high.x}), std::max({low.y - p.y, 0.0f, p.y - high.y}),
                 std::max({low.z - p.z, 0.0f, p.z - high.z})};
    return dot(d, d);
  }
};

}  // namespace divot::math
