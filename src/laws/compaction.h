#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "laws/medium.h"

namespace divot::laws {

/// Depth of soil that feels a patch of size b (radius of a round one, smaller side of others), over b: below it the
/// vertical stress is under a tenth of the pressure [Boussinesq; Terzaghi 1943].
inline constexpr double kPressureBulb = 2;

/// How much of `sinkage`, m, closes pores in a column that had lost `before`, m, and can lose `limit` at most. The
/// nearer it comes to its limit, the less: d closed = (1 - closed / limit) d sinkage.
inline double closed_pores(double sinkage, double before, double limit) {
  if (limit <= 0 || sinkage <= 0) return 0;
  return std::max(0.0, limit - std::max(0.0, before)) * (1 - std::exp(-sinkage / limit));
}

/// Pressure that soil bears under a patch of width b, m, before it fails and flows out, Pa: below it load only closes
/// pores. c Nc + density g b Ngamma / 2 with two thirds of c and tan phi, as soil fails that gives way under the load
/// before all of it shears [Terzaghi 1943, "local shear"]; factors of [Vesic 1973].
inline double bearing_capacity(const Medium& s, double b, double gravity) {
  constexpr double kLocal = 2.0 / 3;
  const double t = kLocal * s.tan_friction, root = t + std::sqrt(1 + t * t);  // tan(45 deg + phi/2)
  const double nq = std::exp(std::numbers::pi * t) * root * root;
  const double nc = t > 1e-3 ? (nq - 1) / t : 2 + std::numbers::pi;
  return kLocal * s.cohesion * nc + s.density * gravity * b * (nq + 1) * t;
}

}  // namespace divot::laws
