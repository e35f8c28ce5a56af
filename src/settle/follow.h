#pragma once

#include <cstdint>
#include <vector>

#include "divot/jobs.h"
#include "laws/medium.h"
#include "settle/ground.h"
#include "settle/ring_kernel.h"
#include "settle/rings.h"

namespace divot::settle {

/// A particle slower than this, or that moves less than this in each step, for so many steps goes to sleep.
struct Stillness {
  float speed = 0;  ///< m/s
  float step = 0;   ///< m
  std::uint16_t steps = 1;
};

/// Arrays that the surface needs to follow; they grow and stay.
struct FollowScratch {
  std::vector<float> lost;          ///< [particle] m^3 that vanished below it in this step
  std::vector<float> dx, dy, dz;    ///< [particle] m it moved in this step
  std::vector<std::uint8_t> moved;  ///< [particle] 1: it did
  std::vector<float> excess;        ///< [particle] that of its column
  std::vector<std::uint8_t> steep;  ///< [particle] see RingArrays
  std::vector<std::uint32_t> part;  ///< [part of the particles] how many moved, or are steep
  Rings rings;
  bool sleepy = false;  ///< somebody has been still for long enough
  int unchanged = 0;    ///< steps since particles changed
};

/// Moves the surface with its particles, counts for how long each has been still, and books what vanished below each as
/// compacted: what its faces sweep while all their corners move evenly, so that volumes sum to what the surface
/// swept. Lists what moved. `kernel` changes no bit.
void follow(const Stillness& stillness, bool particles_changed, Ground& ground, FollowScratch& scratch,
            const Jobs& jobs, const RingKernel& kernel = fastest_rings());

/// Appends to `restless` the moved particles round which there may be something steep; all of them where there are no
/// rings that tell. `slopes`: the least that count.
void add_restless(const Slopes& slopes, const Ground& ground, FollowScratch& scratch, const Jobs& jobs,
                  std::vector<std::uint32_t>& restless, const RingKernel& kernel = fastest_rings());

}  // namespace divot::settle
