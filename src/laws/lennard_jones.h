#pragma once

#include <cmath>

#include "laws/medium.h"
#include "math/real.h"

namespace divot::laws {

/// q^k for a small whole k > 0.
template <class Real>
DIVOT_INLINE Real power(Real q, int k) {
  Real p = q;
  for (int i = 1; i < k; ++i) p = p * q;
  return p;
}

/// Potential of eq. 6, J, with the bond's dissociation energy e0 = bond_energy r0^2, at distance r > 0.
inline float lennard_jones_potential(const Medium& s, float r, float r0) {
  const float e0 = s.bond_energy * r0 * r0, m = s.attraction, n = s.repulsion;
  return -e0 / (m - n) * (m * std::pow(r0 / r, n) - n * std::pow(r0 / r, m));
}

/// Force of eq. 6 over distance, N/m: times (x_i - x_j) it is the force on i, -grad Phi. Zero at r0, positive
/// (repulsive) below.
template <class Real>
DIVOT_INLINE Real lennard_jones(const Medium& s, Real r_squared, Real r0) {
  using math::to_the_power;
  // -dPhi/dr / r = e0 m n / (n - m) [ (r0/r)^n - (r0/r)^m ] / r^2 with e0 = bond_energy r0^2. For even m and n the
  // powers of q = (r0/r)^2 need neither a root nor a power function.
  const Real q = r0 * r0 / r_squared;
  const Real repel = s.half_repulsion ? power(q, s.half_repulsion) : to_the_power(q, s.repulsion * 0.5f);
  const Real attract = s.half_attraction ? power(q, s.half_attraction) : to_the_power(q, s.attraction * 0.5f);
  const float e = s.bond_energy * (s.attraction * s.repulsion / (s.repulsion - s.attraction));
  return Real(e) * q * (repel - attract);
}

}  // namespace divot::laws
