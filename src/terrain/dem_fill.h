#pragma once

#include "terrain/dem_file.h"

namespace divot::terrain {

/// Fills places without data from those around them, by distance (GDAL's FillNodata). Pixels that are all without data
/// stay so. [O(holes x search)]
void fill_holes(DemPixels& pixels);

}  // namespace divot::terrain
