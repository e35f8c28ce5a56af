#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "forces/terms.h"
#include "state/slot_reads.h"

namespace divot::forces {

/// What the kernel reads and writes, as bare pointers: [particle], [column], and bonds as state::Bonds has them.
struct Arrays {
  std::size_t count = 0;
  const float *x, *y, *z, *vx, *vy, *vz, *mass, *flow_rate;
  const std::uint8_t *hold, *material;
  const std::uint32_t* column;
  float *fx, *fy, *fz, *held_pull;
  const float *rest, *plastic, *area;  ///< rest: x, y, z of each column in turn
  const std::uint32_t *first_slot, *neighbour;
  const state::SlotReads* reads;
  const std::uint8_t* medium;
  float* rest_length;
  const Terms* terms;  ///< [material]
  Reach reach;
  bool renew = false;     ///< bonds yield, form and break before they are used
  bool softened = false;  ///< the substep cannot follow everything
  bool flowing = false;   ///< some soil flows
};

/// Force on each particle of blocks [begin, end), without blasts. A block whose particles or neighbours are of several
/// media is given to plain().
using Kernel = void(const Arrays& arrays, std::size_t begin, std::size_t end);

/// Particle by particle: blocks of several media, and the reference the other kernels are held against.
Kernel plain;
/// Eight at a time, for any processor, for those with AVX2 and those with AVX-512. All give the same bits.
Kernel baseline;
Kernel avx2;
Kernel avx512;

/// Every kernel that this processor runs, the fastest first.
std::vector<Kernel*> kernels();

/// The fastest that this processor runs.
Kernel* fastest();

}  // namespace divot::forces
