#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "divot/ids.h"

namespace divot::state {

/// How lanes find what belongs to the eight particles of a slot: in a run, eight that follow each other; in two of
/// them, as where a tile of the ground ends; or each for itself.
struct SlotReads {
  static constexpr std::uint32_t kLanes = 8;
  std::uint32_t run = kNone;    ///< particle for lane 0, whose k-th follower is for lane k; kNone: each for itself
  std::uint32_t other = kNone;  ///< that of the second run
  std::uint32_t lanes = 0;      ///< bits of the lanes that read from the second run
};

/// Reads for a slot's particles, of which those that are kNone may be anything; `count`: of all particles.
inline SlotReads find_reads(const std::array<std::uint32_t, SlotReads::kLanes>& slot, std::size_t count) {
  SlotReads reads;
  for (std::uint32_t lane = 0; lane < SlotReads::kLanes; ++lane) {
    if (slot[lane] == kNone) continue;
    // A run must not leave the arrays.
    const std::uint32_t start = slot[lane] - lane;
    if (slot[lane] < lane || std::size_t{start} + SlotReads::kLanes > count) return {};
    if (reads.run == kNone) reads.run = start;
    if (start == reads.run) continue;
    if (reads.other == kNone) reads.other = start;
    if (start != reads.other) return {};
    reads.lanes |= 1u << lane;
  }
  return reads;
}

}  // namespace divot::state
