#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "laws/medium.h"
#include "state/blasts.h"
#include "state/particles.h"
#include "state/soil.h"
#include "state/surface.h"

namespace divot::refine {

/// The ground whose triangles come and go, and all that knows of its vertices.
struct Ground {
  state::Surface& surface;
  state::Soil& soil;
  state::Particles& particles;
  std::span<state::Blast> blasts;
  std::span<const laws::Medium> media;
  /// Index of the material at x, y in the terrain's coordinates; empty: that of what is around.
  const std::function<std::uint8_t(double x, double y)>& material_at;
  std::vector<std::uint32_t>& touched;  ///< gets vertices that came, went or moved
};

/// Square of an edge's length from above, before the first touch, m^2: triangles are halved by how they were, so that
/// their angles do not depend on what the ground has been through.
double squared_length(const state::Surface& surface, const state::Soil& soil, std::uint32_t half_edge);

/// Puts a vertex in the middle of an edge and returns it. It inherits halfway between the edge's ends: place, soil and
/// what blasts do to it; volumes and areas come in equal parts from both, so that all sums stay as they are. Where the
/// ground around it is awake, it is a particle (the last row; sort_rows() is due then). [O(valence)]
std::uint32_t halve_edge(Ground& ground, std::uint32_t half_edge);

/// Brings the areas that loads and masses count with up to date at vertices whose triangles have changed.
void renew_cells(Ground& ground, std::span<const std::uint32_t> vertices);

/// Brings rows back into ascending order of vertex.
void sort_rows(state::Particles& particles, state::Soil& soil);

}  // namespace divot::refine
