#pragma once

#include "divot/vec.h"

namespace divot::output {

/// Angle between two velocities seen from above, degrees in [0, 180]; 0 where one of them is slower than 1 mm/s that
/// way.
double heading_change_deg(const Vec3d& from, const Vec3d& to);

}  // namespace divot::output
