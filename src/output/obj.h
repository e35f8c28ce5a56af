#pragma once

#include <string>

#include "divot/errors.h"
#include "divot/views.h"

namespace divot::output {

/// Writes the ground as Wavefront OBJ, z up, in the terrain's coordinates, m. Numbers are printed so that reading them
/// gives the same doubles. Holes stay as vertices without a face. Fails with the system's reason. [O(vertices + faces)]
Result<void> write_obj(const std::string& path, const SurfaceView& surface);

}  // namespace divot::output
