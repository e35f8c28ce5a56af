#pragma once

#include <span>
#include <string>

#include "divot/errors.h"
#include "divot/views.h"

namespace divot::output {

/// Writes the ground as binary little-endian PLY: per vertex x, y, z (double, m, in the terrain's coordinates),
/// sinkage (float, m) and material (uchar); faces as uchar count and uint vertices. Holes stay as vertices without a
/// face, so that vertex ids are the world's.
/// `sinkage`: [vertex] m. Fails with the system's reason. [O(vertices + faces)]
Result<void> write_ply(const std::string& path, const SurfaceView& surface, std::span<const float> sinkage);

}  // namespace divot::output
