// The kernel for DIVOT_LANES, which a file defines before it includes this one: see math/lanes.h.
#include "forces/kernel.h"
#include "math/lanes.h"

namespace divot::forces::DIVOT_LANES {

using math::DIVOT_LANES::gather;
using math::DIVOT_LANES::Lanes;
using math::DIVOT_LANES::load;
using math::DIVOT_LANES::Mask;
using math::DIVOT_LANES::SlotReader;
using math::DIVOT_LANES::store;

constexpr std::uint32_t kLanes = Lanes::kCount;
constexpr std::uint8_t kFree = 0, kAnchor = 2;  // of Hold
constexpr std::uint8_t kSeveral = 0xff;         // of Bonds::medium

/// A block's own rows of an array; the last block may have fewer particles than lanes.
struct Block {
  std::size_t begin;
  std::uint32_t size;

  DIVOT_INLINE Lanes own(const float* from) const {
    if (size == kLanes) return load(from + begin);
    Lanes out(0.0f);
    for (std::uint32_t lane = 0; lane < size; ++lane) out.v[lane] = from[begin + lane];
    return out;
  }
  DIVOT_INLINE void put(float* to, Lanes x) const {
    if (size == kLanes) return store(to + begin, x);
    for (std::uint32_t lane = 0; lane < size; ++lane) to[begin + lane] = x.v[lane];
  }
  DIVOT_INLINE Mask is(const std::uint8_t* of, std::uint8_t value) const {
    Mask out{};
    for (std::uint32_t lane = 0; lane < size; ++lane) out.v[lane] = of[begin + lane] == value ? -1 : 0;
    return out;
  }
};

template <bool kRenew, bool kSoftened>
DIVOT_INLINE Sum<Lanes> sum_bonds(const Arrays& a, std::size_t block, const Block& rows, const Terms& terms,
                                  const Reach& reach) {
  const Lanes x = rows.own(a.x), y = rows.own(a.y), z = rows.own(a.z);
  const Lanes vx = rows.own(a.vx), vy = rows.own(a.vy), vz = rows.own(a.vz);
  const Lanes zero(0.0f), mass = kSoftened ? rows.own(a.mass) : zero;
  const Lanes flow = kRenew && a.flowing ? rows.own(a.flow_rate) : zero;
  Sum<Lanes> sum{zero, zero, zero};
  for (std::uint32_t slot = a.first_slot[block]; slot < a.first_slot[block + 1]; ++slot) {
    const state::SlotReads& reads = a.reads[slot];
    const SlotReader of{reads.run, reads.other, reads.lanes, a.neighbour + std::size_t{kLanes} * slot};
    Pair<Lanes> pair;
    Lanes there, flow_there = zero;
    of([&](auto read) DIVOT_INLINE_LAMBDA {
      pair.dx = x - read(a.x), pair.dy = y - read(a.y), pair.dz = z - read(a.z);
      pair.dvx = read(a.vx) - vx, pair.dvy = read(a.vy) - vy, pair.dvz = read(a.vz) - vz;
      if constexpr (kRenew)
        if (a.flowing) flow_there = read(a.flow_rate);
      if constexpr (kSoftened) there = read(a.mass);
    });
    pair.r_squared = squared_length(pair.dx, pair.dy, pair.dz);
    float* rest_length = a.rest_length + std::size_t{kLanes} * slot;
    Lanes r0 = load(rest_length);
    if constexpr (kRenew) {
      r0 = renewed(terms, reach, pair.r_squared, r0, both(flow <= zero, flow_there <= zero));
      store(rest_length, r0);
    }
    Lanes softened(1.0f), damping(terms.medium.viscous_damping);
    if constexpr (kSoftened) {
      const Lanes lighter = least(mass, there);
      softened = softening(terms, lighter), damping = softened_damping(terms, lighter);
    }
    add_bond(terms, reach, pair, r0, softened, damping, sum);
  }
  return sum;
}

DIVOT_INLINE void add_own_of(const Arrays& a, const Block& rows, const Terms& terms, Sum<Lanes>& sum) {
  std::uint32_t column[kLanes], rest[kLanes];
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    column[lane] = a.column[rows.begin + (lane < rows.size ? lane : 0)];
    rest[lane] = 3 * column[lane];
  }
  Own<Lanes> own;
  own.vx = rows.own(a.vx), own.vy = rows.own(a.vy), own.vz = rows.own(a.vz);
  own.mass = rows.own(a.mass), own.flow_rate = rows.own(a.flow_rate);
  own.area = gather(a.area, column), own.plastic = gather(a.plastic, column);
  own.dx = rows.own(a.x) - gather(a.rest, rest);
  own.dy = rows.own(a.y) - gather(a.rest + 1, rest);
  own.dz = rows.own(a.z) - gather(a.rest + 2, rest);
  add_own(terms, own, sum);
}

// The force on a block of one medium. With kCommon its law is eq. 6 with the paper's exponents, 2 and 4, which the
// compiler then knows.
template <bool kRenew, bool kSoftened, bool kCommon>
DIVOT_INLINE void run_block(const Arrays& a, std::size_t block) {
  // Copies: the compiler could not know that forces are not written into them.
  Terms terms = a.terms[a.medium[block]];
  Reach reach = a.reach;
  if constexpr (kCommon) terms.medium.half_attraction = 1, terms.medium.half_repulsion = 2, reach.spring = false;
  const std::size_t first = block * kLanes, left = a.count - first;
  const Block rows{first, left < kLanes ? static_cast<std::uint32_t>(left) : kLanes};
  Sum<Lanes> sum = sum_bonds<kRenew, kSoftened>(a, block, rows, terms, reach);
  const Lanes zero(0.0f);
  rows.put(a.held_pull, select(rows.is(a.hold, kAnchor), zero, sum.z));
  add_own_of(a, rows, terms, sum);
  const Mask free = rows.is(a.hold, kFree);
  rows.put(a.fx, select(free, sum.x, zero));
  rows.put(a.fy, select(free, sum.y, zero));
  rows.put(a.fz, select(free, sum.z, zero));
}

template <bool kRenew, bool kSoftened>
void run(const Arrays& a, std::size_t begin, std::size_t end) {
  for (std::size_t block = begin; block < end; ++block) {
    if (a.medium[block] == kSeveral) {
      plain(a, block, block + 1);
      continue;
    }
    const laws::Medium& medium = a.terms[a.medium[block]].medium;
    if (medium.half_attraction == 1 && medium.half_repulsion == 2 && !a.reach.spring)
      run_block<kRenew, kSoftened, true>(a, block);
    else
      run_block<kRenew, kSoftened, false>(a, block);
  }
}

inline void choose(const Arrays& a, std::size_t begin, std::size_t end) {
  if (a.renew) return a.softened ? run<true, true>(a, begin, end) : run<true, false>(a, begin, end);
  return a.softened ? run<false, true>(a, begin, end) : run<false, false>(a, begin, end);
}

}  // namespace divot::forces::DIVOT_LANES
