#pragma once

#include <span>
#include <string>

#include "divot/errors.h"
#include "divot/views.h"

namespace divot::output {

/// Writes the ground as binary glTF 2.0: one node that turns z up into glTF's y up, with the origin to add for the
/// terrain's coordinates in its `extras`; positions, normals, sinkage as `_SINKAGE` (m) and as vertex colours from
/// brown (unmoved) to dark (sunk) and light (raised). `sinkage`: [vertex] m. Fails with the system's reason.
/// [O(vertices + faces)]
Result<void> write_glb(const std::string& path, const SurfaceView& surface, std::span<const float> sinkage);

}  // namespace divot::output
