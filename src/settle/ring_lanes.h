// The kernel for DIVOT_LANES, which a file defines before it includes this one: see math/lanes.h.
#include "math/lanes.h"
#include "settle/ring_kernel.h"

namespace divot::settle::DIVOT_LANES {

using math::DIVOT_LANES::Lanes;
using math::DIVOT_LANES::load;
using math::DIVOT_LANES::Mask;
using math::DIVOT_LANES::SlotReader;
using math::DIVOT_LANES::store;

constexpr std::uint32_t kLanes = Lanes::kCount;

/// The particles of a block; the last block may have fewer than lanes.
struct Own {
  std::size_t begin;
  std::uint32_t size;
  DIVOT_INLINE Lanes operator()(const float* from) const {
    if (size == kLanes) return load(from + begin);
    Lanes out(0.0f);
    for (std::uint32_t lane = 0; lane < size; ++lane) out.v[lane] = from[begin + lane];
    return out;
  }
};

DIVOT_INLINE Own own_of(const RingArrays& a, std::size_t block) {
  const std::size_t begin = block * kLanes, left = a.count - begin;
  return {begin, left < kLanes ? static_cast<std::uint32_t>(left) : kLanes};
}

DIVOT_INLINE SlotReader reader_of(const RingArrays& a, std::uint32_t slot) {
  const state::SlotReads& reads = a.reads[slot];
  return {reads.run, reads.other, reads.lanes, a.neighbour + std::size_t{kLanes} * slot};
}

inline void sweep(const RingArrays& a, std::size_t begin, std::size_t end) {
  for (std::size_t block = begin; block < end; ++block) {
    const Own own = own_of(a, block);
    const Spoke<Lanes> hub{own(a.x), own(a.y), own(a.z), own(a.dx), own(a.dy), own(a.dz)};
    const auto spoke_of = [&](std::uint32_t slot) DIVOT_INLINE_LAMBDA {
      Spoke<Lanes> to;
      reader_of(a, slot)([&](auto read) DIVOT_INLINE_LAMBDA {
        to = {read(a.x) - hub.x,   read(a.y) - hub.y,   read(a.z) - hub.z,
              read(a.dx) - hub.dx, read(a.dy) - hub.dy, read(a.dz) - hub.dz};
      });
      return halfway(to);
    };
    const std::uint32_t first = a.first[block], last = a.first[block + 1];
    Area<Lanes> area{Lanes(0.0f), Lanes(0.0f), Lanes(0.0f)};
    if (first < last) {
      Spoke<Lanes> before = spoke_of(first);
      for (std::uint32_t slot = first + 1; slot < last; ++slot) {
        const Spoke<Lanes> spoke = spoke_of(slot);
        add_mean_area(before, spoke, area);
        before = spoke;
      }
    }
    const Lanes lost = swept(area, hub.dx, hub.dy, hub.dz);
    if (own.size == kLanes)
      store(a.lost + own.begin, lost);
    else
      for (std::uint32_t lane = 0; lane < own.size; ++lane) a.lost[own.begin + lane] = lost.v[lane];
  }
}

// Whether there is something to look at round each of a block.
template <bool kEdges>
DIVOT_INLINE Mask look_round(const RingArrays& a, const Own& own, std::uint32_t first, std::uint32_t last) {
  const Lanes x = own(a.x), y = own(a.y), z = own(a.z), zero(0.0f);
  Mask steep{};
  if constexpr (kEdges) steep = zero < own(a.excess);
  const auto spoke_of = [&](std::uint32_t slot) DIVOT_INLINE_LAMBDA {
    Spoke<Lanes> to;
    reader_of(a, slot)([&](auto read) DIVOT_INLINE_LAMBDA {
      to = {read(a.x) - x, read(a.y) - y, read(a.z) - z, zero, zero, zero};
      if constexpr (kEdges) steep = either(steep, zero < read(a.excess));
    });
    if constexpr (kEdges) steep = either(steep, is_steep_edge(to, a.slopes));
    return to;
  };
  Spoke<Lanes> before = spoke_of(first);
  for (std::uint32_t slot = first + 1; slot < last; ++slot) {
    const Spoke<Lanes> spoke = spoke_of(slot);
    steep = either(steep, is_steep_face(before, spoke, a.slopes));
    before = spoke;
  }
  return steep;
}

inline void look(const RingArrays& a, std::size_t begin, std::size_t end) {
  for (std::size_t block = begin; block < end; ++block) {
    const Own own = own_of(a, block);
    const std::uint32_t first = a.first[block], last = a.first[block + 1];
    Mask steep{};
    if (first < last)
      steep = a.slopes.edges ? look_round<true>(a, own, first, last) : look_round<false>(a, own, first, last);
    for (std::uint32_t lane = 0; lane < own.size; ++lane)
      a.steep[own.begin + lane] = static_cast<std::uint8_t>(steep.v[lane] & 1);
  }
}

}  // namespace divot::settle::DIVOT_LANES
