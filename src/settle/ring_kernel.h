#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "settle/ring_terms.h"
#include "state/slot_reads.h"

namespace divot::settle {

/// What the kernels read and write, as bare pointers: [particle], and rings as Rings has them.
struct RingArrays {
  std::size_t count = 0;
  const float *x, *y, *z;     ///< m, at the end of the step
  const float *dx, *dy, *dz;  ///< m, moved in it
  const float* excess;        ///< m, of the steep ground below; null: no soil here has cohesion
  const std::uint32_t *first, *neighbour;
  const state::SlotReads* reads;
  float* lost;          ///< m^3 that vanished below
  std::uint8_t* steep;  ///< 1: there may be something to slide, or an excess to bring up to date
  Slopes slopes;
};

/// What each of blocks [begin, end) asks of its rings: `sweep` for `lost`, `look` for `steep`.
struct RingKernel {
  void (*sweep)(const RingArrays& arrays, std::size_t begin, std::size_t end);
  void (*look)(const RingArrays& arrays, std::size_t begin, std::size_t end);
};

/// Eight particles at a time, for any processor, for those with AVX2 and those with AVX-512; the same bits as one by
/// one.
extern const RingKernel kRingsBaseline, kRingsAvx2, kRingsAvx512;

/// Every kernel that this processor runs, the fastest first.
std::vector<const RingKernel*> ring_kernels();

/// The fastest that this processor runs.
const RingKernel& fastest_rings();

}  // namespace divot::settle
