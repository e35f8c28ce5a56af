#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "laws/medium.h"
#include "math/real.h"

namespace divot::laws {

// The soil under a load, be it a free particle or a body.

/// Bekker's pressure at sinkage z under a patch of width b, Pa: p = (kc/b + kphi) z^n; 0 above ground. [Bekker 1969]
template <class Real>
DIVOT_INLINE Real bekker_pressure(const Medium& s, Real z, Real b) {
  using math::greatest, math::to_the_power;
  if constexpr (std::is_floating_point_v<Real>)
    if (!(z > 0)) return 0;  // saves a power, and changes no bit
  const Real k = (s.bekker_kc != 0 ? Real(s.bekker_kc) / b : Real(0)) + Real(s.bekker_kphi),
             sunk = greatest(z, Real(0));
  return k * (s.bekker_n == 1 ? sunk : to_the_power(sunk, s.bekker_n));
}

/// Strength of soil that is loaded in less than a second over that at rest: 1.1 to 1.15 in sands, 1.5 to 3 in clays
/// [Casagrande & Shannon 1948].
inline constexpr double kQuickStrength = 1.5;

/// Pressure of soil that is thrown out of the way at `speed`, m/s, across the load's face, and its slope: C density
/// speed^2. On a ball that is in by half, whose face turns away from its way, the mean C is half of it, the 8/3 of the
/// coefficient of friction of dry grains [Katsuragi & Durian 2013]; and C is at least the 1/2 of any flow that is
/// brought to rest.
template <class Real>
struct Thrown {
  Real value, per_speed;  ///< Pa, Pa s/m
};
template <class Real>
DIVOT_INLINE Thrown<Real> thrown_pressure(const Medium& s, Real speed) {
  using math::greatest;
  const double grains = 16.0 / 3 * s.tan_friction;
  const Real coefficient = Real((grains > 0.5 ? grains : 0.5) * s.density);
  const Real away = greatest(speed, Real(0)), drag = coefficient * away;
  return {drag * away, Real(2) * drag};
}

/// Pressure of a load that comes down, and its slopes.
template <class Real>
struct Pressure {
  Real value = Real(0);                  ///< Pa
  Real slope = Real(0);                  ///< Pa/m, against sinkage
  Real damping = Real(0);                ///< Pa s/m, against speed
  Real throwing = Real(0);               ///< Pa s/m, against speed across the face
  decltype(Real(0) < Real(0)) yields{};  ///< on Bekker's curve: sinkage becomes permanent
};

/// Pressure at sinkage z of soil that has sunk by `plastic` for good: elastic from there until Bekker's curve is met
/// again. Where Bekker's curve starts infinitely steep (n < 1) or is stiffer than the elastic branch, the elastic
/// branch leads. Soil that is pressed at `speed`, m/s, radiates waves, by its damping times that; they carry no more
/// than makes kQuickStrength of Bekker's curve, its strength. What yields is thrown out of the way at the speed
/// `across` the load's face: the larger of both is what quick loading adds, as the strength of quickly loaded soil was
/// measured with its inertia.
template <class Real>
DIVOT_INLINE Pressure<Real> ground_pressure(const Medium& s, Real z, Real plastic, Real b, Real elastic_stiffness,
                                            Real speed = Real(0), Real across = Real(0)) {
  using math::both, math::least, math::select;
  const Real zero = Real(0), elastic = elastic_stiffness * (z - plastic);
  const auto pressed = elastic > zero;
  if constexpr (std::is_floating_point_v<Real>)
    if (!pressed) return {};  // likewise
  const Real virgin = bekker_pressure(s, z, b);
  const auto sunk = virgin > zero, pushed = speed > zero;
  // Of loose soil that lies on top of the ground as it was nothing pushes back yet, and all yields.
  const auto yields = both(pressed, elastic > virgin);
  const Real at_rest = least(elastic, virgin), steepness = Real(s.bekker_n) * virgin / select(sunk, z, Real(1));
  const Real slope = select(yields, steepness, elastic_stiffness);
  const Real waves = select(pushed, Real(s.ground_damping) * speed, zero), most = Real(kQuickStrength) * virgin;
  const auto limited = most < at_rest + waves;
  const Real value = select(limited, most, at_rest + waves);
  const Real value_slope = select(limited, Real(kQuickStrength) * steepness, slope);
  const Real damping = select(limited, zero, select(pushed, Real(s.ground_damping), zero));
  const Thrown<Real> thrown = thrown_pressure(s, select(yields, across, zero));
  const auto throws = value < at_rest + thrown.value;
  return {select(pressed, select(throws, at_rest + thrown.value, value), zero),
          select(pressed, select(throws, slope, value_slope), zero),
          select(both(pressed, throws), zero, select(pressed, damping, zero)),
          select(both(pressed, throws), thrown.per_speed, zero), yields};
}

/// Largest shear stress at normal pressure p, Pa. [Mohr-Coulomb]
template <class Real>
DIVOT_INLINE Real shear_strength(const Medium& s, Real p) {
  return Real(s.cohesion) + p * Real(s.tan_friction);
}

/// Share of the strength that shear displacement j mobilises. [Janosi & Hanamoto 1961]
template <class Real>
DIVOT_INLINE Real mobilised_shear(const Medium& s, Real j) {
  using math::exponential;
  return Real(1.0f) - exponential(-j / Real(s.shear_modulus));
}

/// Beyond this many K of shear displacement the soil slides: 95 % of the strength is mobilised there.
inline constexpr float kSlideShear = 3;

}  // namespace divot::laws
