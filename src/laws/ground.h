#pragma once

#include <limits>

#include "divot/vec.h"
#include "laws/bekker.h"

namespace divot::laws {

/// How the ground under a free particle is evaluated. The patch of a free particle is as wide as the ground that moves with it, so
/// only kphi counts; stiffness is limited to what the substep can follow (a softer hold leaves a free particle in its place as well).
struct GroundStep {
  float stiffness_limit = 0;  ///< Pa/m per kg/m^2
};

/// Elastic stiffness a free particle feels, Pa/m.
inline float held_stiffness(const Medium& s, const GroundStep& step) {
  return std::min(s.elastic_stiffness, step.stiffness_limit * s.areal_mass);
}

/// Traction of the ground on a free particle, Pa: displacement from where its column is at rest, velocity, permanent sinkage.
/// Pressed, it answers by Bekker; pulled, it holds by cohesion; pushed sideways, by Janosi's shear.
inline Vec3 ground_traction(const Medium& s, const Vec3& from_rest, const Vec3& velocity, float plastic,
                            const GroundStep& step) {
  const float stiffness = held_stiffness(s, step);
  constexpr float kWide = std::numeric_limits<float>::infinity();
  const float sunk = -from_rest.z;
  const float normal = sunk > 0 ? ground_pressure(s, plastic + sunk, plastic, kWide, stiffness).value
                                : -std::min(stiffness * -sunk, s.cohesion);

  const float j = std::sqrt(from_rest.x * from_rest.x + from_rest.y * from_rest.y);
  const float strength = shear_strength(s, std::max(normal, 0.0f));
  const float shear = j > 0 ? std::min(strength * mobilised_shear(s, j) / j, stiffness) : 0;
  const float damping = s.ground_damping * std::sqrt(stiffness / s.elastic_stiffness);
  return Vec3{-shear * from_rest.x, -shear * from_rest.y, normal} - damping * velocity;
}

}  // namespace divot::laws
