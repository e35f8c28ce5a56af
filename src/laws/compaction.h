#pragma once

#include <algorithm>
#include <cmath>

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

}  // namespace divot::laws
