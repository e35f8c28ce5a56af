// Eight floats or four doubles side by side. Not a header like others: a file that defines DIVOT_LANES as a name of its
// own includes it and gets the namespace divot::math::DIVOT_LANES, compiled for its own instruction set. No two files
// may share a name, or the linker would keep one set's code for both. Everything is inlined and nothing of the standard
// library is called.

#include <cstdint>

#include "math/real.h"
#ifdef __SSE2__
#include <immintrin.h>
#endif

#ifndef DIVOT_LANES
#error "define DIVOT_LANES first"
#endif

namespace divot::math::DIVOT_LANES {

/// What 32 bytes hold, and whole numbers as wide.
template <class Scalar>
struct Vectors;
template <>
struct Vectors<float> {
  using Real = float __attribute__((vector_size(32)));
  using Whole = std::int32_t __attribute__((vector_size(32)));
};
template <>
struct Vectors<double> {
  using Real = double __attribute__((vector_size(32)));
  using Whole = std::int64_t __attribute__((vector_size(32)));
};

/// Yes or no in each lane: all bits of it set, or none.
template <class Scalar>
struct MaskOf {
  typename Vectors<Scalar>::Whole v;

  DIVOT_INLINE friend MaskOf both(MaskOf a, MaskOf b) { return {a.v & b.v}; }
  DIVOT_INLINE friend MaskOf either(MaskOf a, MaskOf b) { return {a.v | b.v}; }
  DIVOT_INLINE friend bool any(MaskOf mask) {
#ifdef __AVX__
    return _mm256_movemask_epi8(reinterpret_cast<__m256i>(mask.v)) != 0;
#else
    bool found = false;
    for (std::size_t lane = 0; lane < 32 / sizeof(Scalar); ++lane) found |= mask.v[lane] != 0;
    return found;
#endif
  }
};

template <class Scalar>
struct LanesOf {
  using Vector = typename Vectors<Scalar>::Real;
  using Mask = MaskOf<Scalar>;
  static constexpr std::uint32_t kCount = 32 / sizeof(Scalar);
  Vector v;

  LanesOf() = default;
  DIVOT_INLINE LanesOf(Vector vector) : v(vector) {}
  DIVOT_INLINE LanesOf(Scalar x) : v(x - Vector{}) {}

  DIVOT_INLINE friend LanesOf operator+(LanesOf a, LanesOf b) { return a.v + b.v; }
  DIVOT_INLINE friend LanesOf operator-(LanesOf a, LanesOf b) { return a.v - b.v; }
  DIVOT_INLINE friend LanesOf operator*(LanesOf a, LanesOf b) { return a.v * b.v; }
  DIVOT_INLINE friend LanesOf operator/(LanesOf a, LanesOf b) { return a.v / b.v; }
  DIVOT_INLINE friend LanesOf operator-(LanesOf a) { return -a.v; }
  DIVOT_INLINE LanesOf& operator+=(LanesOf b) { return v += b.v, *this; }
  DIVOT_INLINE friend Mask operator<(LanesOf a, LanesOf b) { return {a.v < b.v}; }
  DIVOT_INLINE friend Mask operator<=(LanesOf a, LanesOf b) { return {a.v <= b.v}; }
  DIVOT_INLINE friend Mask operator>(LanesOf a, LanesOf b) { return {a.v > b.v}; }
  DIVOT_INLINE friend Mask operator!=(LanesOf a, LanesOf b) { return {a.v != b.v}; }

  DIVOT_INLINE friend LanesOf select(Mask condition, LanesOf yes, LanesOf no) { return condition.v ? yes.v : no.v; }
  DIVOT_INLINE friend LanesOf least(LanesOf a, LanesOf b) {
#ifdef __AVX__
    if constexpr (kCount == 8)
      return Vector(_mm256_min_ps(__m256(b.v), __m256(a.v)));
    else
      return Vector(_mm256_min_pd(__m256d(b.v), __m256d(a.v)));
#else
    return select(b < a, b, a);
#endif
  }
  DIVOT_INLINE friend LanesOf greatest(LanesOf a, LanesOf b) {
#ifdef __AVX__
    if constexpr (kCount == 8)
      return Vector(_mm256_max_ps(__m256(b.v), __m256(a.v)));
    else
      return Vector(_mm256_max_pd(__m256d(b.v), __m256d(a.v)));
#else
    return select(a < b, b, a);
#endif
  }
  DIVOT_INLINE friend LanesOf root(LanesOf x) {
#ifdef __AVX__
    if constexpr (kCount == 8)
      return Vector(_mm256_sqrt_ps(__m256(x.v)));
    else
      return Vector(_mm256_sqrt_pd(__m256d(x.v)));
#else
    LanesOf out = x;
    for (std::uint32_t lane = 0; lane < kCount; ++lane)
      if constexpr (kCount == 8)
        out.v[lane] = __builtin_sqrtf(x.v[lane]);
      else
        out.v[lane] = __builtin_sqrt(x.v[lane]);
    return out;
#endif
  }
};
using Lanes = LanesOf<float>;
using DoubleLanes = LanesOf<double>;
using Mask = MaskOf<float>;

template <class Scalar>
DIVOT_INLINE LanesOf<Scalar> load(const Scalar* from) {
  LanesOf<Scalar> out;
  __builtin_memcpy(&out.v, from, sizeof out.v);
  return out;
}
template <class Scalar>
DIVOT_INLINE void store(Scalar* to, LanesOf<Scalar> x) {
  __builtin_memcpy(to, &x.v, sizeof x.v);
}

// ---- powers: see math/real.h

template <class Scalar>
struct LaneParts {
  LanesOf<Scalar> mantissa, exponent;
};

DIVOT_INLINE Lanes power_of_two(Lanes n) {
  return reinterpret_cast<Lanes::Vector>((__builtin_convertvector(n.v, Vectors<float>::Whole) + 127) << 23);
}
DIVOT_INLINE LaneParts<float> parts(Lanes x) {
  constexpr std::int32_t kRootOfHalf = 0x3f3504f3;
  const Vectors<float>::Whole bits = reinterpret_cast<Vectors<float>::Whole>(x.v) - kRootOfHalf;
  return {reinterpret_cast<Lanes::Vector>((bits & 0x7fffff) + kRootOfHalf),
          __builtin_convertvector(bits >> 23, Lanes::Vector)};
}

using Bits = std::uint64_t __attribute__((vector_size(32)));
DIVOT_INLINE DoubleLanes power_of_two(DoubleLanes n) {
  const DoubleLanes sum = n + DoubleLanes(0x1.8p52);
  return reinterpret_cast<DoubleLanes::Vector>((reinterpret_cast<Bits>(sum.v) << 52) + 0x3ff0000000000000u);
}
DIVOT_INLINE LaneParts<double> parts(DoubleLanes x) {
  constexpr std::uint64_t kRootOfHalf = 0x3fe6a09e667f3bcd, kOne = 0x3ff0000000000000, kFraction = 0xfffffffffffff;
  const Bits bits = reinterpret_cast<Bits>(x.v) - kRootOfHalf;
  const DoubleLanes exponent = reinterpret_cast<DoubleLanes::Vector>((bits + kOne) >> 52 | 0x4330000000000000u);
  return {reinterpret_cast<DoubleLanes::Vector>((bits & kFraction) + kRootOfHalf),
          exponent - DoubleLanes(0x1p52 + 1023)};
}
DIVOT_INLINE DoubleLanes exponential(DoubleLanes x) { return math::exponential_of_double(x); }
DIVOT_INLINE DoubleLanes to_the_power(DoubleLanes x, float y) { return math::power_of_double(x, y); }

// ---- slots: what eight particles read

/// Lanes whose bit is set.
DIVOT_INLINE Mask mask_of(std::uint32_t bits) {
  const auto all = static_cast<std::int32_t>(bits);
  const Vectors<float>::Whole bit{1, 2, 4, 8, 16, 32, 64, 128};
  return {(Vectors<float>::Whole{all, all, all, all, all, all, all, all} & bit) == bit};
}

/// from[index[lane]] in each lane. One load a lane: gather instructions are slower on most processors.
DIVOT_INLINE Lanes gather(const float* from, const std::uint32_t* index) {
  return Lanes::Vector{from[index[0]], from[index[1]], from[index[2]], from[index[3]],
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
