#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "divot/errors.h"
#include "divot/vec.h"
#include "state/surface.h"

namespace divot::terrain {

/// Heights on a north-up grid in metres: what every source of terrain is brought to.
struct HeightField {
  state::Raster raster;
  std::vector<float> height;  ///< [row * columns + column] m, row 0 southernmost; NaN where there is no data

  float at(std::uint32_t column, std::uint32_t row) const {
    return height[static_cast<std::size_t>(row) * raster.layout.columns + column];
  }
};

/// Fails, with the count, the limit and the memory it would take, when columns * rows is more than `max_vertices` or
/// than ids can number, or when there is no cell. `where` gives file and key of the error.
Result<void> check_size(std::uint64_t columns, std::uint64_t rows, std::uint64_t max_vertices, Error where);

/// The surface over a height field, around `origin`. Fails when no three neighbouring vertices have heights.
/// `where` gives file and key of the error. [O(vertices)]
Result<state::Surface> build_surface(HeightField field, const Vec3d& origin, Error where);

}  // namespace divot::terrain
