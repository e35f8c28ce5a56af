#pragma once

#include <cstdint>

#include "divot/errors.h"
#include "divot/scene.h"
#include "state/surface.h"

namespace divot::terrain {

/// The ground over a mesh, around the centre of its bounding box, with the mean horizontal length of its edges as its
/// spacing. Fails on a mesh without triangles, on numbers that are not finite, on triangles that make no surface (see
/// HalfEdgeMesh::build), that do not face up or that lie above each other (looked for at all vertices and centres), and
/// on more than `max_vertices`. [O(triangles log triangles)]
Result<state::Surface> load_mesh(const MeshTerrain& mesh, std::uint64_t max_vertices);

}  // namespace divot::terrain
