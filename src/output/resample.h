#pragma once

#include "divot/raster.h"
#include "state/soil.h"
#include "state/surface.h"

namespace divot::output {

/// Heights of a surface made from a grid, at the grid's own nodes, with their change since the start and the sinkage of
/// the soil that is there. Particles stay close to the node they started from,
/// so each node's triangle is found by walking over the mesh from its vertex; a node that the surface has left (at the
/// border, or where it folds) takes its vertex' height. `surface.raster` must be there. [O(nodes), a few steps each]
RasterView resample(const state::Surface& surface, const state::Soil& soil = {});

}  // namespace divot::output
