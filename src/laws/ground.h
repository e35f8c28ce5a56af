#pragma once

#include <limits>

#include "divot/vec.h"
#include "laws/bekker.h"

namespace divot::laws {

/// The fastest motion that a substep can follow. Whatever would be faster is softened: a free particle is held in its
/// place by a softer hold as well.
struct Resolution {
  float rate = 0;  ///< 1/s

  /// Most stiffness (N/m per kg, or Pa/m per kg/m^2) and damping (N s/m per kg) that bonds and ground may each have.
  float stiffness_limit() const { return 0.5f * rate * rate; }
  float damping_limit() const { return 0.5f * rate; }
};

/// Elastic stiffness a free particle feels, Pa/m.
inline float held_stiffness(const Medium& s, const Resolution& resolution) {
  return std::min(s.elastic_stiffness, resolution.stiffness_limit() * s.areal_mass);
}

/// Traction of the ground on a free particle, Pa: displacement from where its column is at rest, velocity, permanent
/// sinkage. Pressed, it answers by Bekker; pulled, it holds by cohesion; pushed sideways, by Janosi's shear.
inline Vec3 ground_traction(const Medium& s, const Vec3& from_rest, const Vec3& velocity, float plastic,
                            const Resolution& resolution) {
  const float stiffness = held_stiffness(s, resolution);
  constexpr float kWide = std::numeric_limits<float>::infinity();
  const float sunk = -from_rest.z;
  const float normal = sunk > 0 ? ground_pressure(s, plastic + sunk, plastic, kWide, stiffness).value
                                : -std::min(stiffness * -sunk, s.cohesion);

  const float j = std::sqrt(from_rest.x * from_rest.x + from_rest.y * from_rest.y);
  const float strength = shear_strength(s, std::max(normal, 0.0f));
  const float shear = j > 0 ? std::min(strength * mobilised_shear(s, j) / j, stiffness) : 0;
  const float damping = std::min(s.ground_damping, resolution.damping_limit() * s.areal_mass);
  return Vec3{-shear * from_rest.x, -shear * from_rest.y, normal} - damping * velocity;
}

}  // namespace divot::laws
