#pragma once

#include <cmath>

#include "laws/medium.h"

namespace divot::laws {

/// q^k for a small whole k > 0.
inline float power(float q, int k) {
  float p = q;
  for (int i = 1; i < k; ++i) p *= q;
  return p;
}

/// Potential of eq. 6, J, with the bond's dissociation energy e0 = bond_energy r0^2, at distance r > 0.
inline float lennard_jones_potential(const Medium& s, float r, float r0) {
  const float e0 = s.bond_energy * r0 * r0, m = s.attraction, n = s.repulsion;
  return -e0 / (m - n) * (m * std::pow(r0 / r, n) - n * std::pow(r0 / r, m));
}

/// Force of eq. 6 over distance, N/m: times (x_i - x_j) it is the force on i, -grad Phi. Zero at r0, positive
/// (repulsive) below.
inline float lennard_jones(const Medium& s, float r_squared, float r0) {
  const float r0_squared = r0 * r0, q = r0_squared / r_squared;
  const float m = s.attraction, n = s.repulsion;
  // -dPhi/dr / r = e0 m n / (n - m) [ (r0/r)^n - (r0/r)^m ] / r^2. For even m and n the powers of (r0/r)^2 need no
  // root.
  const float repel = s.half_repulsion ? power(q, s.half_repulsion) : std::pow(q, n / 2);
  const float attract = s.half_attraction ? power(q, s.half_attraction) : std::pow(q, m / 2);
  return s.bond_energy * r0_squared * (m * n / (n - m)) * (repel - attract) / r_squared;
}

}  // namespace divot::laws
