#include "output/heading.h"

#include <cmath>
#include <numbers>

namespace divot::output {

namespace {

constexpr double kStill = 1e-3;  // m/s

bool has_heading(const Vec3d& v) { return v.x * v.x + v.y * v.y > kStill * kStill; }

}  // namespace

double heading_change_deg(const Vec3d& from, const Vec3d& to) {
  if (!has_heading(from) || !has_heading(to)) return 0;
  const double along = from.x * to.x + from.y * to.y, across = from.x * to.y - from.y * to.x;
  return std::abs(std::atan2(across, along)) * 180 / std::numbers::pi;
}

}  // namespace divot::output
