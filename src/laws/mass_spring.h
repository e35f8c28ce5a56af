#pragma once

#include "laws/medium.h"

namespace divot::laws {

/// Force of eq. 1 over distance, N/m: times (x_i - x_j) it is the force on i. Zero at r0, positive (repulsive) below.
template <class Real>
DIVOT_INLINE Real mass_spring(const Medium& s, Real r, Real r0) {
  return Real(s.spring_stiffness) * (r0 - r) / r;
}

}  // namespace divot::laws
