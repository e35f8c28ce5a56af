#pragma once

#include <cstdint>
#include <vector>

#include "divot/shape.h"

namespace divot::output {

/// A body's surface in its shape's axes, for drawing.
struct BodyMesh {
  std::vector<Vec3d> vertices;           ///< m
  std::vector<std::uint32_t> triangles;  ///< [3 * face] outward
};

/// The surface of a shape; a compound's is that of its parts one by one. Hulls need their corners and triangles, as a
/// BodyView has them. [O(corners)]
BodyMesh body_mesh(const Shape& shape);

}  // namespace divot::output
