#pragma once

#include <cstdint>
#include <vector>

#include "divot/jobs.h"
#include "state/particles.h"
#include "state/slot_reads.h"
#include "state/soil.h"
#include "state/surface.h"

namespace divot::settle {

/// The vertices round each awake particle, counter-clockwise, as rows of particles: the fan of its faces without the
/// half-edges. Laid out like state::Bonds, in blocks of eight particles and slots of one neighbour of each.
struct Rings {
  static constexpr std::uint32_t kLanes = state::SlotReads::kLanes;

  bool valid = false;                    ///< they are those of the particles as they are
  std::vector<std::uint32_t> first;      ///< [block + 1] its first slot
  std::vector<std::uint32_t> neighbour;  ///< [slot][lane] particle; some come twice where other fans have more faces
  std::vector<state::SlotReads> reads;   ///< [slot] how its neighbours are found
  std::vector<std::uint8_t> border;      ///< [particle] 1: faces do not go all the way round
};

/// Makes the rings of all particles but anchors, whose lanes mean nothing. They stay invalid where a neighbour is no
/// particle.
void make_rings(const state::Particles& particles, const state::Soil& soil, const state::Surface& surface, Rings& rings,
                const Jobs& jobs);

}  // namespace divot::settle
