#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "laws/medium.h"

namespace divot::laws {

// When ground slides, and how fast.

/// Dry grains have no cohesion at a free surface: what is fitted to them under wheels is the curve of their envelope,
/// at most so much among the sands and gravels of [Wong 2008], Pa.
inline constexpr float kApparentCohesion = 1.6e3f;

/// Slopes count as at rest up to this much beyond that of rest: half a degree.
inline constexpr double kAtRest = 0.01;

/// Height up to which the soil stands vertically, m: 4 c / (density g) tan(45 deg + phi / 2) [Terzaghi 1943].
inline double critical_height(const Medium& s, double gravity) {
  const double cohesion = std::max(0.0f, s.cohesion - kApparentCohesion), t = s.tan_friction;
  return 4 * cohesion / (s.density * gravity) * (t + std::sqrt(1 + t * t));
}

/// What of an `excess`, m, by which cohesive ground falls beyond its slope of rest, counts against that height where it
/// is so steep. A slope of height H has an excess of H (1 - x), x = rest / slope, and stands while H (1 - x)^2 is less:
/// the safe side of [Taylor 1937], whose slopes stand H (1 - x)^2 to H (1 - x)^4 high.
inline double counted_height(double excess, double slope, double rest) { return excess * (1 - rest / slope); }

/// What a slide is faster by the more it exceeds its slope of `rest`: of the height that it falls friction takes the
/// share rest / slope, and speed goes with the root of what is left. It stops in a finite time.
inline double root_of_excess(double slope, double rest) { return std::sqrt(1 - rest / slope); }

/// How easily ground flows down a slope, m^2/s: in a layer a third as thick as the whole slide is high, soil moves as
/// fast as something that fell so far.
inline double slide_mobility(double height, double gravity) { return 0.3 * height * std::sqrt(gravity * height); }

}  // namespace divot::laws
