#pragma once

#include <cstdint>
#include <vector>

#include "divot/vec.h"

namespace divot::state {

/// A bomb that went off: what it still does to the ground, and what it did.
struct Blast {
  Vec3 ground_zero;     ///< m, on the ground, relative to the surface's origin
  Vec3 direction;       ///< unit, into the ground: what the pressure pushes along
  double yield = 0;     ///< t of TNT
  double height = 0;    ///< m, of the charge over ground zero, negative: buried
  double start = 0;     ///< s, of the step in which it went off
  double pulse = 0;     ///< s, duration of the pressure pulse, which falls linearly to 0
  float flow_rate = 0;  ///< 1/s, drag of the ground it makes flow; 0: the ground keeps its skeleton

  // Ground that fails, ascending by vertex.
  std::vector<std::uint32_t> column;  ///< [pushed]
  std::vector<float> push;            ///< [pushed] m/s^2 along `direction` at the start of the pulse
  std::vector<float> thrown;          ///< [pushed] share of the volume lost there that lands on `landing`

  // Ground on which the ejecta land and that is pushed up, ascending by vertex; empty when the model throws none.
  std::vector<std::uint32_t> landing;  ///< [landing] column
  std::vector<float> landing_height;   ///< [landing] m gained for each m^3 thrown: sums to 1 over area
  double radius = 0;                   ///< m, of the largest crater of any soil here, 0 where it leaves none
  bool active = true;                  ///< what it pushed may still move
};

}  // namespace divot::state
