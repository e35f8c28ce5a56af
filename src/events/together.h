#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "events/scaled_blast.h"
#include "state/blasts.h"
#include "state/soil.h"
#include "state/surface.h"

namespace divot::events {

/// The blasts before a new one whose ground does not rest yet. Their craters are not there for it to find, nor does it
/// make one of its own in them: of what both would break, energies add up and not depths. A crater at rest is ground
/// like any other.
class Company {
 public:
  Company(const state::Blast& blast, std::span<const state::Blast> earlier, const state::Surface& surface,
          const state::Soil& soil);

  /// How far the ground at a vertex sank on behalf of the others, m. [O(others log pushed)]
  double sunk(std::uint32_t vertex) const;

  /// How far the ground zero of the new one sank. [O(pushed)]
  double ground_zero_sunk() const;

  /// Makes of the new burst, whose own crater has `radius`, that of all charges together: each of the others counts by
  /// the share of its broken ground that both break; yields add up, and place and height are their mean.
  void join(Burst& burst, state::Blast& blast, double radius) const;

 private:
  const state::Blast& blast_;
  const state::Surface& surface_;
  const state::Soil& soil_;
  std::vector<const state::Blast*> others_;
};

/// Of ground that both push, the new blast digs what is left to do, and all that leaves it is the new one's to throw.
/// What one throws does not land where the other digs.
void share_ground(state::Blast& blast, std::span<state::Blast> earlier, const state::Soil& soil);

}  // namespace divot::events
