#include "output/body_mesh.h"

#include <cmath>
#include <numbers>

namespace divot::output {

// A ball of rings and segments, so fine that its outline looks round.
BodyMesh body_mesh(const BodyView& body) {
  constexpr std::uint32_t kRings = 16, kSegments = 32;
  BodyMesh mesh;
  for (std::uint32_t i = 0; i <= kRings; ++i) {
    for (std::uint32_t j = 0; j < kSegments; ++j) {
      const double a = std::numbers::pi * i / kRings, b = 2 * std::numbers::pi * j / kSegments;
      mesh.vertices.push_back(body.radius * Vec3d{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)});
      if (i == kRings) continue;
      const std::uint32_t here = i * kSegments + j, next = i * kSegments + (j + 1) % kSegments;
      mesh.triangles.insert(mesh.triangles.end(),
                            {here, here + kSegments, next + kSegments, here, next + kSegments, next});
    }
  }
  return mesh;
}

}  // namespace divot::output
