#pragma once

#include <string>

#include "divot/errors.h"
#include "divot/raster.h"

namespace divot::output {

/// What stands in the file where there is no height.
inline constexpr float kNodata = -9999;

/// Writes heights as a float32 GeoTIFF, north up, deflated, pixel centres on the terrain's grid, holes as kNodata.
/// Fails with the system's or GDAL's reason. [O(pixels)]
Result<void> write_geotiff(const std::string& path, const RasterView& raster);

}  // namespace divot::output
