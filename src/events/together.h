#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "events/scaled_blast.h"
#include "state/blasts.h"
#include "state/soil.h"
#include "state/surface.h"

namespace divot::events {

/// A charge, and the blast's place with it.
struct Charge {
  Burst burst;
  state::Blast blast;  ///< where it is, and its pulse
};

/// The blasts before a new one whose ground does not rest yet. Their craters are not there for it to find: of what both
/// would break, energies add up and not depths. A crater at rest is ground like any other.
class Company {
 public:
  Company(const state::Blast& blast, std::span<const state::Blast> earlier, const state::Surface& surface,
          const state::Soil& soil);

  /// How far the ground at a vertex sank on behalf of the others, m. [O(others log pushed)]
  double sunk(std::uint32_t vertex) const;

  /// How far the ground zero of the new one sank. [O(pushed)]
  double ground_zero_sunk() const;

  /// How far what the others threw has raised the ground at a vertex, m. [O(others log landing)]
  double raised(std::uint32_t vertex) const;

  /// The charges that dig the crater of the new one, whose own has `radius`: itself and, with others, the common charge
  /// of all that break the same ground. Each counts in it by the share of its broken ground that two break; yields add
  /// up, and place and height are their mean, so that it does not matter which comes first.
  std::vector<Charge> diggers(const Charge& own, double radius) const;
  /// Those of the others that go off at the same moment and break ground of its: all throw on one common lip.
  std::vector<Charge> at_once(const Charge& own, double radius) const;

 private:
  double share(const state::Blast& other, const Charge& own, double radius) const;

  const state::Blast& blast_;
  const state::Surface& surface_;
  const state::Soil& soil_;
  std::vector<const state::Blast*> others_;
};

/// Of ground that both push, the new blast digs what is left to do, and all that leaves it is the new one's to throw.
/// What one throws does not land where the other digs, and those that go off at one moment throw on the same lip.
void share_ground(state::Blast& blast, std::span<state::Blast> earlier, const state::Soil& soil);

}  // namespace divot::events
