#pragma once

#include <cstdint>

#include "divot/errors.h"
#include "divot/scene.h"
#include "terrain/dem_file.h"
#include "terrain/height_field.h"

namespace divot::terrain {

/// Brings pixels to a north-up grid in metres. Fails where the coordinates look like degrees and nobody says so, on
/// coordinate systems that are neither projected nor geographic, and on geographic models wider than 20 degrees.
/// [O(pixels)]
Result<HeightField> to_metres(const DemTerrain& dem, DemPixels pixels, std::uint64_t max_vertices);

}  // namespace divot::terrain
