#pragma once

#include <cstdint>
#include <string>

#include "divot/errors.h"
#include "divot/scene.h"
#include "state/surface.h"

namespace divot::terrain {

/// The surface of the mesh in the file `mesh.path`, which starts at `folder` when it is relative; its axis `up` becomes
/// z and its units metres. Fails, naming the file, like the reader and load_mesh(). [O(size log size)]
Result<state::Surface> load_mesh_file(const MeshTerrain& mesh, const std::string& folder, std::uint64_t max_vertices);

}  // namespace divot::terrain
