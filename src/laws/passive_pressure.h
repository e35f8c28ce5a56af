#pragma once

#include <cmath>

#include "laws/medium.h"

namespace divot::laws {

/// Force by which soil that stands `height` above the foot of a wall resists being pushed by it, N per metre of wall:
/// density g height^2 Kp / 2 + 2 c height sqrt(Kp), Kp = tan^2(45 deg + phi/2) [Rankine 1857]. The upper `loose` of it
/// has no cohesion.
inline double passive_force(const Medium& s, double height, double loose, double gravity) {
  const double root = s.tan_friction + std::sqrt(1 + s.tan_friction * s.tan_friction);  // tan(45 deg + phi/2)
  const double grown = height > loose ? height - loose : 0;
  return 0.5 * s.density * gravity * height * height * root * root + 2 * s.cohesion * grown * root;
}

}  // namespace divot::laws
