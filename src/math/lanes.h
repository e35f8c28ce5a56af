// Eight floats side by side. Not a header like others: a file that defines DIVOT_LANES as a name of its own includes it
// and gets the namespace divot::math::DIVOT_LANES, compiled for its own instruction set. No two files may share a name,
// or the linker would keep one set's code for both. Everything is inlined and nothing of the standard library is
// called.

#include <cstdint>

#include "math/real.h"
#ifdef __SSE2__
#include <immintrin.h>
#endif

#ifndef DIVOT_LANES
#error "define DIVOT_LANES first"
#endif

namespace divot::math::DIVOT_LANES {

using FloatVector = float __attribute__((vector_size(32)));
using IntVector = std::int32_t __attribute__((vector_size(32)));

/// Eight yes or no: all bits of a lane set, or none.
struct Mask {
  IntVector v;
};

struct Lanes {
  static constexpr std::uint32_t kCount = 8;
  FloatVector v;

  Lanes() = default;
  DIVOT_INLINE Lanes(FloatVector vector) : v(vector) {}
  DIVOT_INLINE Lanes(float x) : v{x, x, x, x, x, x, x, x} {}

  DIVOT_INLINE friend Lanes operator+(Lanes a, Lanes b) { return a.v + b.v; }
  DIVOT_INLINE friend Lanes operator-(Lanes a, Lanes b) { return a.v - b.v; }
  DIVOT_INLINE friend Lanes operator*(Lanes a, Lanes b) { return a.v * b.v; }
  DIVOT_INLINE friend Lanes operator/(Lanes a, Lanes b) { return a.v / b.v; }
  DIVOT_INLINE friend Lanes operator-(Lanes a) { return -a.v; }
  DIVOT_INLINE Lanes& operator+=(Lanes b) { return v += b.v, *this; }
  DIVOT_INLINE friend Mask operator<(Lanes a, Lanes b) { return {a.v < b.v}; }
  DIVOT_INLINE friend Mask operator<=(Lanes a, Lanes b) { return {a.v <= b.v}; }
  DIVOT_INLINE friend Mask operator>(Lanes a, Lanes b) { return {a.v > b.v}; }
  DIVOT_INLINE friend Mask operator!=(Lanes a, Lanes b) { return {a.v != b.v}; }
};

DIVOT_INLINE Lanes select(Mask condition, Lanes yes, Lanes no) { return condition.v ? yes.v : no.v; }
DIVOT_INLINE Mask both(Mask a, Mask b) { return {a.v & b.v}; }
DIVOT_INLINE Mask either(Mask a, Mask b) { return {a.v | b.v}; }
DIVOT_INLINE bool any(Mask mask) {
#ifdef __AVX__
  return _mm256_movemask_ps(reinterpret_cast<__m256>(mask.v)) != 0;
#else
  bool found = false;
  for (int lane = 0; lane < 8; ++lane) found |= mask.v[lane] != 0;
  return found;
#endif
}

/// Lanes whose bit is set.
DIVOT_INLINE Mask mask_of(std::uint32_t bits) {
  const auto all = static_cast<std::int32_t>(bits);
  const IntVector bit{1, 2, 4, 8, 16, 32, 64, 128};
  return {(IntVector{all, all, all, all, all, all, all, all} & bit) == bit};
}

DIVOT_INLINE Lanes least(Lanes a, Lanes b) {
#ifdef __AVX__
  return FloatVector(_mm256_min_ps(__m256(b.v), __m256(a.v)));
#else
  return select(b < a, b, a);
#endif
}
DIVOT_INLINE Lanes greatest(Lanes a, Lanes b) {
#ifdef __AVX__
  return FloatVector(_mm256_max_ps(__m256(b.v), __m256(a.v)));
#else
  return select(a < b, b, a);
#endif
}

DIVOT_INLINE Lanes root(Lanes x) {
#ifdef __AVX__
  return FloatVector(_mm256_sqrt_ps(__m256(x.v)));
#else
  Lanes out = x;
  for (int lane = 0; lane < 8; ++lane) out.v[lane] = __builtin_sqrtf(x.v[lane]);
  return out;
#endif
}

DIVOT_INLINE Lanes power_of_two(Lanes n) {
  return reinterpret_cast<FloatVector>((__builtin_convertvector(n.v, IntVector) + 127) << 23);
}

struct LaneParts {
  Lanes mantissa, exponent;
};
DIVOT_INLINE LaneParts parts(Lanes x) {
  constexpr std::int32_t kRootOfHalf = 0x3f3504f3;
  const IntVector bits = reinterpret_cast<IntVector>(x.v) - kRootOfHalf;
  return {reinterpret_cast<FloatVector>((bits & 0x7fffff) + kRootOfHalf),
          __builtin_convertvector(bits >> 23, FloatVector)};
}

DIVOT_INLINE Lanes load(const float* from) {
  Lanes out;
  __builtin_memcpy(&out.v, from, sizeof out.v);
  return out;
}
DIVOT_INLINE void store(float* to, Lanes x) { __builtin_memcpy(to, &x.v, sizeof x.v); }

/// from[index[lane]] in each lane. One load a lane: gather instructions are slower on most processors.
DIVOT_INLINE Lanes gather(const float* from, const std::uint32_t* index) {
  return FloatVector{from[index[0]], from[index[1]], from[index[2]], from[index[3]],
                     from[index[4]], from[index[5]], from[index[6]], from[index[7]]};
}

/// What belongs to the eight particles of a slot, in any array; see state::SlotReads.
struct SlotReader {
  std::uint32_t run, other, lanes;
  const std::uint32_t* index;

  /// Calls f(read) with a read(array) for the way that this slot is read: one branch for any number of arrays.
  template <class F>
  DIVOT_INLINE void operator()(F f) const {
    const std::uint32_t first = run, second = other;
    const std::uint32_t* const from_all_over = index;
    if (run == 0xffffffff) return f([=](const float* from) { return gather(from, from_all_over); });
    if (lanes == 0) return f([=](const float* from) { return load(from + first); });
    const Mask from_second = mask_of(lanes);
    f([=](const float* from) { return select(from_second, load(from + second), load(from + first)); });
  }
};

}  // namespace divot::math::DIVOT_LANES
