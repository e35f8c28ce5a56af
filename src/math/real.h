#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

// What the laws need of a number beyond + - * /, for one float or double. math/lanes.h has the same for eight floats
// side by side, so that one text of a law serves both: it says `using math::select;` and calls select(...). Powers and
// exponentials of floats are polynomials of our own, because their bits must not depend on how wide the registers are.
namespace divot::math {

/// For templates that lanes go through: what is not inlined takes its vectors through memory.
#define DIVOT_INLINE [[gnu::always_inline]] inline
#define DIVOT_INLINE_LAMBDA __attribute__((always_inline))

inline float select(bool condition, float yes, float no) { return condition ? yes : no; }
inline double select(bool condition, double yes, double no) { return condition ? yes : no; }
inline bool both(bool a, bool b) { return a && b; }

/// The lesser and the greater; `a` when they are equal or cannot be compared.
inline float least(float a, float b) { return b < a ? b : a; }
inline double least(double a, double b) { return b < a ? b : a; }
inline float greatest(float a, float b) { return a < b ? b : a; }
inline double greatest(double a, double b) { return a < b ? b : a; }

inline float root(float x) { return std::sqrt(x); }
inline double root(double x) { return std::sqrt(x); }

/// 2^n for a whole n in [-126, 127].
inline float power_of_two(float n) { return std::bit_cast<float>((static_cast<std::int32_t>(n) + 127) << 23); }

/// x = mantissa 2^exponent with the mantissa in [sqrt(1/2), sqrt(2)); x > 0 and not denormal.
template <class Real>
struct Parts {
  Real mantissa, exponent;
};
inline Parts<float> parts(float x) {
  constexpr std::int32_t kRootOfHalf = 0x3f3504f3;
  const std::int32_t bits = std::bit_cast<std::int32_t>(x) - kRootOfHalf;
  return {std::bit_cast<float>((bits & 0x7fffff) + kRootOfHalf), static_cast<float>(bits >> 23)};
}

/// e^x, to 2 units in the last place; x is cut to [-87, 88]. [Cephes, expf]
template <class Real>
DIVOT_INLINE Real exponential(Real x) {
  x = least(greatest(x, Real(-87.0f)), Real(88.0f));
  // To the nearest whole number: what is added leaves no room for fractions.
  const Real n = (x * Real(1.44269504f) + Real(12582912.0f)) - Real(12582912.0f);
  const Real r = (x - n * Real(0.693359375f)) - n * Real(-2.12194440e-4f);
  Real p = Real(1.9875691500e-4f);
  p = p * r + Real(1.3981999507e-3f);
  p = p * r + Real(8.3334519073e-3f);
  p = p * r + Real(4.1665795894e-2f);
  p = p * r + Real(1.6666665459e-1f);
  p = p * r + Real(5.0000001201e-1f);
  return ((p * (r * r) + r) + Real(1.0f)) * power_of_two(n);
}
inline double exponential(double x) { return std::exp(x); }

/// Natural logarithm, to 2 units in the last place; x > 0 and not denormal. [Cephes, logf]
template <class Real>
DIVOT_INLINE Real logarithm(Real x) {
  const auto [mantissa, exponent] = parts(x);
  const Real r = mantissa - Real(1.0f), r_squared = r * r;
  Real p = Real(7.0376836292e-2f);
  p = p * r + Real(-1.1514610310e-1f);
  p = p * r + Real(1.1676998740e-1f);
  p = p * r + Real(-1.2420140846e-1f);
  p = p * r + Real(1.4249322787e-1f);
  p = p * r + Real(-1.6668057665e-1f);
  p = p * r + Real(2.0000714765e-1f);
  p = p * r + Real(-2.4999993993e-1f);
  p = p * r + Real(3.3333331174e-1f);
  const Real tail = (p * r) * r_squared + exponent * Real(-2.12194440e-4f) - Real(0.5f) * r_squared;
  return (r + tail) + exponent * Real(0.693359375f);
}

/// x^y for x >= 0: 0 below the least number that is not denormal. Relative error 1e-7 (2 + |y ln x|).
template <class Real>
DIVOT_INLINE Real to_the_power(Real x, float y) {
  const Real least_normal = Real(1.17549435e-38f);
  return select(x < least_normal, Real(0.0f), exponential(Real(y) * logarithm(greatest(x, least_normal))));
}
inline double to_the_power(double x, double y) { return std::pow(x, y); }

}  // namespace divot::math
