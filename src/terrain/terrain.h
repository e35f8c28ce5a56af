#pragma once

#include "divot/errors.h"
#include "divot/scene.h"
#include "state/surface.h"

// Stage      terrain
// Reads      Scene::terrain, Scene::folder, the elevation model's file
// Writes     the whole state::Surface, except which material is where (all 0)
// Parallel   no: once per world
// Sums       none
namespace divot::terrain {

/// The ground a scene starts with. Fails on a grid, mesh or file that is not usable, naming file and key, and before
/// memory is taken on one that is larger than TerrainSource::max_vertices. [O(vertices)]
Result<state::Surface> load_terrain(const Scene& scene);

/// A number that two surfaces share only where they are the same: places, triangles and materials. [O(vertices)]
std::uint64_t fingerprint(const state::Surface& surface);

}  // namespace divot::terrain
