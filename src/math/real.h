#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

// What the laws need of a number beyond + - * /, for one float or double. math/lanes.h has the same for eight floats
// or four doubles side by side, so that one text of a law serves all: it says `using math::select;` and calls
// select(...). Powers and exponentials are polynomials of our own, because their bits must not depend on how wide the
// registers are, nor on the system's library.
namespace divot::math {

/// For templates that lanes go through: what is not inlined takes its vectors through memory.
#define DIVOT_INLINE [[gnu::always_inline]] inline
#define DIVOT_INLINE_LAMBDA __attribute__((always_inline))

inline float select(bool condition, float yes, float no) { return condition ? yes : no; }
inline double select(bool condition, double yes, double no) { return condition ? yes : no; }
inline bool both(bool a, bool b) { return a && b; }
inline bool either(bool a, bool b) { return a || b; }
inline bool any(bool yes) { return yes; }

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

// ---- the same for doubles, by functions of another name, as the number of terms differs

inline constexpr double kLeastNormal = 2.2250738585072014e-308;

/// 2^n for a whole n in [-1022, 1023].
inline double power_of_two(double n) {
  // The sum's lowest bits are n.
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(n + 0x1.8p52) << 52) + 0x3ff0000000000000u);
}
inline Parts<double> parts(double x) {
  constexpr std::uint64_t kRootOfHalf = 0x3fe6a09e667f3bcd, kOne = 0x3ff0000000000000, kFraction = 0xfffffffffffff;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x) - kRootOfHalf;
  // The exponent plus 1023 is made a double by setting the lowest bits of 2^52.
  return {std::bit_cast<double>((bits & kFraction) + kRootOfHalf),
          std::bit_cast<double>((bits + kOne) >> 52 | 0x4330000000000000u) - (0x1p52 + 1023)};
}

/// e^x, to 1 unit in the last place; x is cut to [-708, 709]. [fdlibm, e_exp.c]
template <class Real>
DIVOT_INLINE Real exponential_of_double(Real x) {
  x = least(greatest(x, Real(-708.0)), Real(709.0));
  const Real n = (x * Real(1.44269504088896338700) + Real(0x1.8p52)) - Real(0x1.8p52);
  const Real high = x - n * Real(6.93147180369123816490e-01), low = n * Real(1.90821492927058770002e-10);
  const Real r = high - low, t = r * r;
  Real p = Real(4.13813679705723846039e-08);
  p = p * t + Real(-1.65339022054652515390e-06);
  p = p * t + Real(6.61375632143793436117e-05);
  p = p * t + Real(-2.77777777770155933842e-03);
  p = p * t + Real(1.66666666666666019037e-01);
  const Real c = r - t * p;
  return (Real(1.0) - ((low - (r * c) / (Real(2.0) - c)) - high)) * power_of_two(n);
}

/// Natural logarithm, to 1 unit in the last place; x > 0 and not denormal. [fdlibm, e_log.c]
template <class Real>
DIVOT_INLINE Real logarithm_of_double(Real x) {
  const auto [mantissa, exponent] = parts(x);
  const Real f = mantissa - Real(1.0), s = f / (Real(2.0) + f), z = s * s, half = Real(0.5) * f * f;
  Real p = Real(1.479819860511658591e-01);
  p = p * z + Real(1.531383769920937332e-01);
  p = p * z + Real(1.818357216161805012e-01);
  p = p * z + Real(2.222219843214978396e-01);
  p = p * z + Real(2.857142874366239149e-01);
  p = p * z + Real(3.999999999940941908e-01);
  p = p * z + Real(6.666666666666735130e-01);
  const Real tail = s * (half + p * z) + exponent * Real(1.90821492927058770002e-10);
  return exponent * Real(6.93147180369123816490e-01) - ((half - tail) - f);
}

template <class Real>
DIVOT_INLINE Real power_of_double(Real x, double y) {
  return select(x < Real(kLeastNormal), Real(0.0),
                exponential_of_double(Real(y) * logarithm_of_double(greatest(x, Real(kLeastNormal)))));
}

inline double exponential(double x) { return exponential_of_double(x); }
/// x^y for x >= 0: 0 below the least number that is not denormal. Relative error 1e-16 (2 + |y ln x|).
inline double to_the_power(double x, float y) { return power_of_double(x, y); }

}  // namespace divot::math
