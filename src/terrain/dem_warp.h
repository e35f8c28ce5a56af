#pragma once

#include <cstdint>

#include "divot/errors.h"
#include "divot/scene.h"
#include "terrain/dem_file.h"

namespace divot::terrain {

/// Resamples pixels to a north-up grid of square cells in `target`, about as fine as they were. Outer rows and columns
/// that are mostly without data are left out. Fails with what GDAL says and on more than `max_vertices`. [O(pixels)]
Result<DemPixels> warp(const DemTerrain& dem, DemPixels& source, const OGRSpatialReference& target,
                       std::uint64_t max_vertices);

}  // namespace divot::terrain
