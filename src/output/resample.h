#pragma once

#include <array>
#include <cstdint>

#include "divot/raster.h"
#include "state/soil.h"
#include "state/surface.h"

namespace divot::output {

/// Columns and rows of pixels at most `spacing` apart, m, the grid's own nodes among them; 0: these alone.
std::array<std::uint64_t, 2> pixels_of(const state::Raster& grid, double spacing);

/// Heights of a surface made from a grid, at such pixels, with their change since the start and the sinkage of the soil
/// that is there. Particles stay close to the node they started from, so each pixel's triangle is found by walking over
/// the mesh from the vertex of a node; a pixel that the surface has left (at the border, or where it folds) takes the
/// height of what was there at the start. `surface.raster` must be there. [O(pixels), a few steps each]
RasterView resample(const state::Surface& surface, const state::Soil& soil = {}, double spacing = 0);

}  // namespace divot::output
