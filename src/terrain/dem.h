#pragma once

#include <cstdint>

#include "divot/errors.h"
#include "divot/scene.h"
#include "state/surface.h"

namespace divot::terrain {

/// A digital elevation model as terrain in metres, vertices at pixel centres, holes where it has no data.
///
/// Projected coordinates are kept (in metres, also where the file has feet) and Surface::origin is their middle.
/// Degrees and rotated grids are resampled to a north-up grid; degrees become metres east and north of the model's
/// middle (transverse Mercator, WGS 84).
/// Fails, naming file or key, on what cannot be read or understood; reads nothing of a model with more than
/// `max_vertices`. `dem.path` is taken as it is. [O(vertices)]
Result<state::Surface> load_dem(const DemTerrain& dem, std::uint64_t max_vertices);

}  // namespace divot::terrain
