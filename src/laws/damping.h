#pragma once

#include "divot/vec.h"

namespace divot::laws {

/// Eq. 2: what a neighbour at velocity v_j does to a particle at v_i, N.
inline Vec3 viscous_damping(float coefficient, const Vec3& v_i, const Vec3& v_j) { return coefficient * (v_j - v_i); }

/// Eq. 3, N: `coefficient` is gamma, kg/s.
inline Vec3 global_damping(float coefficient, const Vec3& v) { return -coefficient * v; }

}  // namespace divot::laws
