#pragma once

#include <string>
#include <vector>

#include "divot/errors.h"
#include "divot/vec.h"

namespace divot::scene {

/// The vertices of an OBJ, STL (text or binary) or PLY (text or binary) file, in its own units. Repeated ones are kept.
/// Fails with `file` and what is wrong with it. [O(size)]
Result<std::vector<Vec3d>> read_mesh_points(const std::string& path);

}  // namespace divot::scene
