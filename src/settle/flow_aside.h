#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/id_set.h"
#include "laws/medium.h"
#include "settle/ground.h"
#include "state/bodies.h"

namespace divot::settle {

/// Arrays the flow needs; they grow and stay.
struct FlowScratch {
  /// A vertex beside what a body presses.
  struct Beside {
    std::uint32_t vertex = 0;
    double distance = 0;  ///< m, along edges from what the body presses
    double x = 0, y = 0;  ///< m, of the patch's edge on the way there
    double area = 0;      ///< m^2, state::vertex_area()
    double weight = 0;    ///< of the soil that comes to this side
    double side = 0;      ///< where round the patch, in sectors
  };
  std::vector<std::uint32_t> first, carried;  ///< particles by the body that carries them, ascending
  core::IdSet met;                            ///< vertices in rings so far
  std::vector<Beside> ring, next, beside;
};

/// Soil that bodies have pressed beyond what its pores can give flows out from under them: forward where the body's
/// underside moves sideways over the ground in this step, otherwise by the shortest way down the pressure, and lies
/// loose beside the patch. [O(what bodies carry, and what lies beside it)]
void flow_aside(std::span<const state::Body> bodies, std::span<const laws::Medium> media, const Step& step,
                Ground& ground, FlowScratch& scratch);

}  // namespace divot::settle
