#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "divot/ids.h"
#include "divot/vec.h"
#include "state/surface.h"

namespace divot::state {

/// What the ground remembers at the vertices that were ever touched: one column of soil under each. Columns are made in
/// the order of first touch and never go away.
struct Soil {
  std::vector<std::uint32_t> vertex;    ///< [column] surface vertex
  std::vector<std::uint32_t> particle;  ///< [column] row in Particles while awake, else kNone; activation/
  std::vector<Vec3> original;           ///< [column] where the vertex was before the first touch, m
  std::vector<Vec3> rest;               ///< [column] where it stands without load, m; forces/, contact/, settle/
  std::vector<float> plastic;           ///< [column] sinkage that load has made permanent, m: where Bekker's curve is
                                        ///< re-entered; negative: loose soil on top
  std::vector<Vec3> shear;              ///< [column] shear displacement j under the body that touches it, m; contact/
  std::vector<float> area;              ///< [column] volume that it gains by the height it rises, m^2: vertex_area()
  std::vector<float> cell;              ///< [column] horizontal area that loads and masses count with, m^2: cell_area()

  // The books of each column, in m^3 at the density of undisturbed soil. What the surface sinks in all is what all
  // columns were compacted by, since what one gains another gives.
  std::vector<double> gained;     ///< [column] soil that came here, less what left; sums to 0; settle/
  std::vector<double> compacted;  ///< [column] volume lost by getting denser, negative where looser; settle/

  // Slopes.
  std::vector<float> loose;   ///< [column] thickness of soil that was thrown, pushed or slid here, m; settle/
  std::vector<float> excess;  ///< [column] fall beyond the slope of rest of the steep ground below, m; settle/
  std::vector<std::uint32_t> restless;  ///< vertices round which the ground may be too steep, ascending; settle/
  std::size_t size() const { return vertex.size(); }

  /// A column's ground rises by so much, m, or sinks: what it would lie at without cohesion stays where it is.
  void lift_excess(std::uint32_t c, float rises) {
    if (excess[c] > 0) excess[c] = std::max(0.0f, excess[c] + rises);
  }

  /// Height at which the soil would stand had it never been pressed, m: sinkage z of Bekker's law counts from here.
  float fresh_height(std::uint32_t c) const { return rest[c].z + plastic[c]; }
};

/// The column under a vertex, made on first touch. [O(valence) then, O(1) later]
std::uint32_t touch_column(Surface& surface, Soil& soil, std::uint32_t vertex);

/// Volume that is gained under a vertex by the height it rises: a third of its faces' horizontal area, m^2.
/// [O(valence)]
double vertex_area(const Surface& surface, std::uint32_t vertex);

/// Horizontal area of what is nearer to a vertex than to any other, m^2: on a square grid a square, whatever the
/// diagonals, where vertex_area() alternates between 2/3 and 4/3 of it. Of a face with an obtuse corner that one gets
/// half [Meyer et al. 2003]. [O(valence)]
float cell_area(const Surface& surface, std::uint32_t vertex);
/// The same for the ground before the first touch.
float cell_area_before(const Surface& surface, const Soil& soil, std::uint32_t vertex);

/// Where a vertex was before the first touch, m.
inline Vec3 original_place(const Surface& surface, const Soil& soil, std::uint32_t vertex) {
  const std::uint32_t column = surface.column[vertex];
  return column == kNone ? surface.position[vertex] : soil.original[column];
}

}  // namespace divot::state
