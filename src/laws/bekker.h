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

/// Strength of soil that is loaded in less than a second over that at rest: 1.1 to 1.15 in sands, 1.5 to 3 in clays
/// [Casagrande & Shannon 1948].
inline constexpr double kQuickStrength = 1.5;

/// Pressure of a load that comes down, and its slopes.
template <class Real>
struct Pressure {
  Real value = 0;       ///< Pa
  Real slope = 0;       ///< Pa/m, against sinkage
  Real damping = 0;     ///< Pa s/m, against speed
  bool yields = false;  ///< on Bekker's curve: sinkage becomes permanent
};

/// Pressure at sinkage z of soil that has sunk by `plastic` for good: elastic from there until Bekker's curve is met
/// again. Where Bekker's curve starts infinitely steep (n < 1) or is stiffer than the elastic branch, the elastic
/// branch leads. Soil that is pressed at `speed`, m/s, radiates waves, by its damping times that; they carry no more
/// than makes kQuickStrength of Bekker's curve, its strength.
template <class Real>
Pressure<Real> ground_pressure(const Medium& s, Real z, Real plastic, Real b, Real elastic_stiffness, Real speed = 0) {
  const Real elastic = elastic_stiffness * (z - plastic);
  if (elastic <= 0) return {};
  const Real virgin = bekker_pressure(s, z, b);
  if (virgin <= 0) return {0, 0, 0, true};  // loose soil that lies on top
  const bool yields = elastic > virgin;
  const Real at_rest = yields ? virgin : elastic, steepness = s.bekker_n * virgin / z;
  const Real slope = yields ? steepness : elastic_stiffness, waves = speed > 0 ? s.ground_damping * speed : 0;
  const Real most = Real(kQuickStrength) * virgin;
  if (at_rest + waves > most) return {most, Real(kQuickStrength) * steepness, 0, yields};
  return {at_rest + waves, slope, speed > 0 ? s.ground_damping : 0, yields};
}

/// Pressure of soil that is thrown out of the way at `speed`, m/s, across the load's face: C density speed^2. C is 8/3
/// of the coefficient of friction in dry grains [Katsuragi & Durian 2013], and at least the 1/2 of any flow that is
/// brought to rest.
template <class Real>
Pressure<Real> throwing_pressure(const Medium& s, Real speed) {
  if (speed <= 0) return {};
  const Real drag = std::max(Real(0.5), Real(8.0 / 3) * s.tan_friction) * s.density * speed;
  return {drag * speed, 0, 2 * drag, false};
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
