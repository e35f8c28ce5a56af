#pragma once

#include "divot/vec.h"

namespace divot::output {

/// Angle between two velocities seen from above, degrees in [0, 180]; 0 when one of them has no horizontal part.
double heading_change_deg(const Vec3d& from, const Vec3d& to);

}  // namespace divot::output
