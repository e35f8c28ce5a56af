#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace divot {

/// The ground as a north-up raster, for files and for other programs: a copy.
struct RasterView {
  std::uint32_t columns = 0;   ///< from west to east
  std::uint32_t rows = 0;      ///< from north to south
  double x0 = 0;               ///< m, centre of the first pixel, the north-western one, in the terrain's coordinates
  double y0 = 0;               ///< m, likewise
  double dx = 0;               ///< m, > 0, size of a pixel: x grows with the column
  double dy = 0;               ///< m, > 0, likewise: y falls with the row
  std::string crs;             ///< WKT of the coordinates; empty when unknown
  std::string file_crs;        ///< WKT of the model in degrees that the terrain is from, as GeoTIFFs are; else empty
  std::vector<float> heights;  ///< [row * columns + column] m, row 0 northernmost
  std::vector<float>
      change;  ///< [row * columns + column] m, height less that at the start: what was raised is positive
  std::vector<float>
      sinkage;  ///< [row * columns + column] m, how far the soil that is there lies below where it started
  std::vector<std::uint8_t> holes;  ///< [row * columns + column] 1: no data there, the numbers mean nothing
};

}  // namespace divot
