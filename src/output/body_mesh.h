#pragma once

#include <cstdint>
#include <vector>

#include "divot/views.h"

namespace divot::output {

/// A body's surface in its own axes, for drawing.
struct BodyMesh {
  std::vector<Vec3d> vertices;           ///< m
  std::vector<std::uint32_t> triangles;  ///< [3 * face] outward
};

BodyMesh body_mesh(const BodyView& body);

}  // namespace divot::output
