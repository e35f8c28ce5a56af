#pragma once

#include <optional>
#include <string>

#include "divot/errors.h"
#include "divot/raster.h"
#include "divot/world.h"
#include "output/csv.h"

namespace divot::output {

/// What every run leaves in its folder: `summary.json`, `bodies.csv`, `terrain_final.ply` and, for terrain made from a
/// grid, `terrain_final.tif`.
/// `bodies`: the rows collected on the way; `raster`: the final ground, if it has one; `wall_s`: how long the run took,
/// s. Every file is tried; fails with all that could not be written. [O(vertices)]
Result<void> write_results(const World& world, const std::string& folder, double wall_s, BodiesCsv bodies,
                           const std::optional<RasterView>& raster);

}  // namespace divot::output
