#pragma once

#include <ogr_spatialref.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "divot/errors.h"
#include "divot/scene.h"

namespace divot::terrain {

/// One band of a raster file, as it is stored.
struct DemPixels {
  std::uint32_t columns = 0, rows = 0;
  /// x = t[0] + i t[1] + j t[2], y = t[3] + i t[4] + j t[5] at column i and row j counted from the first pixel's
  /// corner.
  std::array<double, 6> transform{};
  OGRSpatialReference crs;    ///< without its vertical part; empty when unknown
  std::vector<float> height;  ///< [row * columns + column] m, NaN where there is no data
};

/// An error about the scene's elevation model.
Error dem_error(const DemTerrain& dem, std::string problem, std::string expected);

/// `crs` as WKT, empty when it is.
std::string wkt_of(const OGRSpatialReference& crs);

/// Reads `dem.band` with GDAL: scale, offset and unit of height applied, coordinate system from `dem.crs` or the file.
/// Fails on a missing file, one that is no raster or cut short, a band that is not there, an unknown coordinate system
/// or unit of height, and before reading on more than `max_vertices`. [O(pixels)]
Result<DemPixels> read_dem(const DemTerrain& dem, std::uint64_t max_vertices);

}  // namespace divot::terrain
