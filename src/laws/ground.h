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

/// Damping of the ground that a free particle feels, Pa s/m.
inline float held_damping(const Medium& s, const Resolution& resolution) {
  return std::min(s.ground_damping, resolution.damping_limit() * s.areal_mass);
}

/// Damping of eq. 3 that a free particle feels, kg/(s m^2).
inline float global_damping(const Medium& s, const Resolution& resolution) {
  return std::min(s.areal_damping, resolution.damping_limit() * s.areal_mass);
}

template <class Real>
struct Traction {
  Real x, y, z;  ///< Pa
};

/// Traction of the ground on a free particle: displacement dx, dy, dz from where its column is at rest, velocity,
/// permanent sinkage; `stiffness` and `damping` are held_stiffness() and held_damping(). Pressed, it answers by Bekker;
/// pulled, it holds by cohesion; pushed sideways, by Janosi's shear.
template <class Real>
DIVOT_INLINE Traction<Real> ground_traction(const Medium& s, float stiffness, float damping, Real dx, Real dy, Real dz,
                                            Real vx, Real vy, Real vz, Real plastic) {
  using math::greatest, math::least, math::root, math::select, math::to_the_power;
  const Real zero = Real(0.0f), sunk = -dz, elastic = Real(stiffness) * sunk;

  // A free particle's patch has no edge: b is infinite. Where z is not above 0 nothing pushes, though it is pressed.
  const Real z = greatest(plastic + sunk, zero);
  const Real virgin = Real(s.bekker_kphi) * (s.bekker_n == 1 ? z : to_the_power(z, s.bekker_n));
  const Real normal = select(sunk > zero, least(elastic, virgin), greatest(elastic, Real(-s.cohesion - s.weight)));

  const Real j = root(dx * dx + dy * dy);
  const Real strength = Real(s.cohesion) + greatest(normal, zero) * Real(s.tan_friction);
  const Real shear = select(j > zero, least(strength * mobilised_shear(s, j) / j, Real(stiffness)), zero);
  return {-shear * dx - Real(damping) * vx, -shear * dy - Real(damping) * vy, normal - Real(damping) * vz};
}

inline Vec3 ground_traction(const Medium& s, const Vec3& from_rest, const Vec3& velocity, float plastic,
                            const Resolution& resolution) {
  const Traction<float> t =
      ground_traction<float>(s, held_stiffness(s, resolution), held_damping(s, resolution), from_rest.x, from_rest.y,
                             from_rest.z, velocity.x, velocity.y, velocity.z, plastic);
  return {t.x, t.y, t.z};
}

}  // namespace divot::laws
