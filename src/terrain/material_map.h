#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "divot/errors.h"
#include "divot/scene.h"
#include "state/surface.h"

namespace divot::terrain {

/// Writes which of `materials` is at every vertex: by the terrain's map, by its mesh's own list, or one everywhere.
/// A map that says where it lies is placed there, in its own coordinate system; others are stretched over the terrain,
/// their first row along the north. The nearest pixel decides, so that borders stay sharp; where the map has no data or
/// does not reach, the terrain's own material is.
/// Fails, naming file or key, on a map that cannot be read, has more pixels than TerrainSource::max_vertices (before
/// memory is taken), lies beside the terrain, holds what the legend does not have or does not hold what it has.
/// [O(pixels + vertices)]
Result<void> place_materials(const Scene& scene, std::span<const Material> materials, state::Surface& surface);

/// Index of the material at x, y in the terrain's coordinates.
using MaterialAt = std::function<std::uint8_t(double x, double y)>;

/// What the terrain's map says between vertices, for new ones; empty where there is no map. Fails as place_materials()
/// does.
Result<MaterialAt> material_between(const Scene& scene, std::span<const Material> materials,
                                    const state::Surface& surface);

}  // namespace divot::terrain
