#pragma once

#include <ogr_spatialref.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "divot/errors.h"
#include "divot/scene.h"

namespace divot::terrain {

/// A material map as it is stored: what every pixel stands for.
struct MapPixels {
  static constexpr std::uint8_t kNoEntry = 255;  ///< no data there
  std::uint32_t columns = 0, rows = 0;
  /// As DemPixels::transform; none where the file does not say where it lies.
  std::optional<std::array<double, 6>> transform;
  OGRSpatialReference crs;          ///< empty when unknown
  std::vector<std::uint8_t> entry;  ///< [row * columns + column] index into the legend; row 0 is the first
};

/// An error about the scene's material map.
Error map_error(const MaterialMap& map, std::string problem, std::string expected);

/// Reads a map of at most kNoEntry legend entries. `map.image` is taken as it is. See place_materials(). [O(pixels)]
Result<MapPixels> read_map(const MaterialMap& map, std::uint64_t max_pixels);

}  // namespace divot::terrain
