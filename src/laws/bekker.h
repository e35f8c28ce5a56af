#pragma once

#include <algorithm>
#include <cmath>

#include "laws/medium.h"
#include "math/real.h"

namespace divot::laws {

// The soil under a load, be it a free particle or a body.

/// Bekker's pressure at sinkage z under a patch of width b, Pa: p = (kc/b + kphi) z^n; 0 above ground. [Bekker 1969]
template <class Real>
Real bekker_pressure(const Medium& s, Real z, Real b) {
  if (z <= 0) return 0;
  const Real k = (s.bekker_kc != 0 ? s.bekker_kc / b : Real(0)) + s.bekker_kphi;
  return k * (s.bekker_n == 1 ? z : math::to_the_power(z, Real(s.bekker_n)));
}

/// Pressure and its slope against sinkage.
template <class Real>
struct Pressure {
  Real value = 0;       ///< Pa
  Real slope = 0;       ///< Pa/m
  bool yields = false;  ///< on Bekker's curve: sinkage becomes permanent
};

/// Pressure at sinkage z of soil that has sunk by `plastic` for good: elastic from there until Bekker's curve is met
/// again. Where Bekker's curve starts infinitely steep (n < 1) or is stiffer than the elastic branch, the elastic
/// branch leads.
template <class Real>
Pressure<Real> ground_pressure(const Medium& s, Real z, Real plastic, Real b, Real elastic_stiffness) {
  const Real elastic = elastic_stiffness * (z - plastic);
  if (elastic <= 0) return {};
  const Real virgin = bekker_pressure(s, z, b);
  if (virgin <= 0) return {0, 0, true};  // loose soil that lies on top
  if (elastic <= virgin) return {elastic, elastic_stiffness, false};
  return {virgin, s.bekker_n * virgin / z, true};
}

/// Largest shear stress at normal pressure p, Pa. [Mohr-Coulomb]
template <class Real>
Real shear_strength(const Medium& s, Real p) {
  return s.cohesion + p * s.tan_friction;
}

/// Share of the strength that shear displacement j mobilises. [Janosi & Hanamoto 1961]
template <class Real>
DIVOT_INLINE Real mobilised_shear(const Medium& s, Real j) {
  return Real(1) - math::exponential(-j / Real(s.shear_modulus));
}

/// Beyond this many K of shear displacement the soil slides: 95 % of the strength is mobilised there.
inline constexpr float kSlideShear = 3;

}  // namespace divot::laws
