#pragma once

#include <span>
#include <string>

#include "divot/errors.h"
#include "divot/raster.h"

namespace divot::output {

/// What stands in a GeoTIFF where there is no height.
inline constexpr float kNodata = -9999;

/// Writes `values` ([pixel] m, of the raster's own: heights, change or sinkage) as a float32 GeoTIFF, north up,
/// deflated, pixel centres on the terrain's grid, holes as kNodata. Of terrain from a model in degrees it is in that
/// model's coordinate system, north up, pixels about as large, bilinear between the terrain's. Fails with the system's
/// or GDAL's reason. [O(pixels)]
Result<void> write_geotiff(const std::string& path, const RasterView& raster, std::span<const float> values);

/// Writes the heights as 16-bit grey PNG: 1 is the lowest, 65535 the highest, 0 a hole. `path`.aux.xml beside it holds
/// scale, offset, nodata and place, so that GDAL (and a scene's `dem`) reads metres again, within half a step.
/// Fails with the system's or GDAL's reason. [O(pixels)]
Result<void> write_png16(const std::string& path, const RasterView& raster);

}  // namespace divot::output
