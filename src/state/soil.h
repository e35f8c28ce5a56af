#pragma once

#include <cstdint>
#include <vector>

#include "divot/ids.h"
#include "divot/vec.h"

namespace divot::state {

/// What the ground remembers at the vertices that were ever touched: one column of soil under each. Columns are made by
/// activation/ in the order of first touch and never go away.
struct Soil {
  std::vector<std::uint32_t> vertex;    ///< [column] surface vertex
  std::vector<std::uint32_t> particle;  ///< [column] row in Particles while awake, else kNone; activation/
  std::vector<Vec3> original;           ///< [column] where the vertex was before the first touch, m
  std::vector<Vec3> rest;               ///< [column] where it stands without load, m; forces/, contact/, settle/
  std::vector<float> plastic;           ///< [column] sinkage that load has made permanent, m: where Bekker's curve is re-entered
  std::vector<Vec3> shear;              ///< [column] shear displacement j under the body that touches it, m; contact/
  std::vector<float> area;              ///< [column] horizontal area it stands for, m^2
  std::vector<float> compacted;         ///< [column] loss of height by compaction, m; settle/
  std::size_t size() const { return vertex.size(); }

  /// Height at which the soil would stand had it never been pressed, m: sinkage z of Bekker's law counts from here.
  float fresh_height(std::uint32_t c) const { return rest[c].z + plastic[c]; }
};

}  // namespace divot::state
