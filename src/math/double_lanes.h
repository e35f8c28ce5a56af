// Four doubles side by side: math/lanes.h for numbers that floats are too coarse for. Included in the same way, into
// the same namespace.

#include <cstdint>

#include "math/real.h"
#ifdef __SSE2__
#include <immintrin.h>
#endif

#ifndef DIVOT_LANES
#error "define DIVOT_LANES first"
#endif

namespace divot::math::DIVOT_LANES {

using DoubleVector = double __attribute__((vector_size(32)));
using LongVector = std::int64_t __attribute__((vector_size(32)));
using UnsignedVector = std::uint64_t __attribute__((vector_size(32)));

/// Four yes or no: all bits of a lane set, or none.
struct DoubleMask {
  LongVector v;
};

struct DoubleLanes {
  static constexpr std::uint32_t kCount = 4;
  DoubleVector v;

  DoubleLanes() = default;
  DIVOT_INLINE DoubleLanes(DoubleVector vector) : v(vector) {}
  DIVOT_INLINE DoubleLanes(double x) : v{x, x, x, x} {}

  DIVOT_INLINE friend DoubleLanes operator+(DoubleLanes a, DoubleLanes b) { return a.v + b.v; }
  DIVOT_INLINE friend DoubleLanes operator-(DoubleLanes a, DoubleLanes b) { return a.v - b.v; }
  DIVOT_INLINE friend DoubleLanes operator*(DoubleLanes a, DoubleLanes b) { return a.v * b.v; }
  DIVOT_INLINE friend DoubleLanes operator/(DoubleLanes a, DoubleLanes b) { return a.v / b.v; }
  DIVOT_INLINE friend DoubleLanes operator-(DoubleLanes a) { return -a.v; }
  DIVOT_INLINE DoubleLanes& operator+=(DoubleLanes b) { return v += b.v, *this; }
  DIVOT_INLINE friend DoubleMask operator<(DoubleLanes a, DoubleLanes b) { return {a.v < b.v}; }
  DIVOT_INLINE friend DoubleMask operator<=(DoubleLanes a, DoubleLanes b) { return {a.v <= b.v}; }
  DIVOT_INLINE friend DoubleMask operator>(DoubleLanes a, DoubleLanes b) { return {a.v > b.v}; }
};

DIVOT_INLINE DoubleLanes select(DoubleMask condition, DoubleLanes yes, DoubleLanes no) {
  return condition.v ? yes.v : no.v;
}
DIVOT_INLINE DoubleMask both(DoubleMask a, DoubleMask b) { return {a.v & b.v}; }
DIVOT_INLINE DoubleMask either(DoubleMask a, DoubleMask b) { return {a.v | b.v}; }
DIVOT_INLINE bool any(DoubleMask mask) {
#ifdef __AVX__
  return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask.v)) != 0;
#else
  return (mask.v[0] | mask.v[1] | mask.v[2] | mask.v[3]) != 0;
#endif
}

DIVOT_INLINE DoubleLanes least(DoubleLanes a, DoubleLanes b) {
#ifdef __AVX__
  return DoubleVector(_mm256_min_pd(__m256d(b.v), __m256d(a.v)));
#else
  return select(b < a, b, a);
#endif
}
DIVOT_INLINE DoubleLanes greatest(DoubleLanes a, DoubleLanes b) {
#ifdef __AVX__
  return DoubleVector(_mm256_max_pd(__m256d(b.v), __m256d(a.v)));
#else
  return select(a < b, b, a);
#endif
}

DIVOT_INLINE DoubleLanes root(DoubleLanes x) {
#ifdef __AVX__
  return DoubleVector(_mm256_sqrt_pd(__m256d(x.v)));
#else
  DoubleLanes out = x;
  for (int lane = 0; lane < 4; ++lane) out.v[lane] = __builtin_sqrt(x.v[lane]);
  return out;
#endif
}

DIVOT_INLINE DoubleLanes power_of_two(DoubleLanes n) {
  const DoubleLanes sum = n + DoubleLanes(0x1.8p52);
  return reinterpret_cast<DoubleVector>((reinterpret_cast<UnsignedVector>(sum.v) << 52) + 0x3ff0000000000000u);
}

struct DoubleLaneParts {
  DoubleLanes mantissa, exponent;
};
DIVOT_INLINE DoubleLaneParts parts(DoubleLanes x) {
  constexpr std::uint64_t kRootOfHalf = 0x3fe6a09e667f3bcd, kOne = 0x3ff0000000000000, kFraction = 0xfffffffffffff;
  const UnsignedVector bits = reinterpret_cast<UnsignedVector>(x.v) - kRootOfHalf;
  const DoubleLanes exponent = reinterpret_cast<DoubleVector>((bits + kOne) >> 52 | 0x4330000000000000u);
  return {reinterpret_cast<DoubleVector>((bits & kFraction) + kRootOfHalf), exponent - DoubleLanes(0x1p52 + 1023)};
}

DIVOT_INLINE DoubleLanes exponential(DoubleLanes x) { return math::exponential_of_double(x); }
DIVOT_INLINE DoubleLanes to_the_power(DoubleLanes x, float y) { return math::power_of_double(x, y); }

DIVOT_INLINE DoubleLanes load(const double* from) {
  DoubleLanes out;
  __builtin_memcpy(&out.v, from, sizeof out.v);
  return out;
}
DIVOT_INLINE void store(double* to, DoubleLanes x) { __builtin_memcpy(to, &x.v, sizeof x.v); }

}  // namespace divot::math::DIVOT_LANES
