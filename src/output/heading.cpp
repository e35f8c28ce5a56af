#include "output/heading.h"

#include <cmath>

namespace divot::output {

double heading_change_deg(const Vec3d& from, const Vec3d& to) {
  const double along = from.x * to.x + from.y * to.y, across = from.x * to.y - from.y * to.x;
  return std::abs(std::atan2(across, along)) * 180 / 3.14159265358979323846;
}

}  // namespace divot::output
