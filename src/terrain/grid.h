#pragma once

#include <cstdint>

#include "divot/errors.h"
#include "divot/scene.h"
#include "state/surface.h"

namespace divot::terrain {

/// A regular grid around (0, 0, 0), flat or after GridTerrain::height. Fails on sizes below 2, a spacing that is not
/// above 0, a height that is not finite or a function that throws, and on more than `max_vertices`. [O(vertices)]
Result<state::Surface> load_grid(const GridTerrain& grid, std::uint64_t max_vertices);

}  // namespace divot::terrain
