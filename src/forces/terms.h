#pragma once

#include <cstddef>
#include <cstdint>

#include "laws/ground.h"
#include "laws/lennard_jones.h"
#include "laws/mass_spring.h"
#include "laws/medium.h"
#include "math/real.h"

// The terms of which a particle's force is made, for one float or for lanes of eight: what the kernel and its plain
// reference share, so that they give the same bits.
namespace divot::forces {

/// A medium and what follows from it and from the substep.
struct Terms {
  laws::Medium medium;
  float bond_stiffness = 0;                    ///< N/m: of two materials the weaker holds the bond
  float soften_bonds = 0, soften_damping = 0;  ///< 1/kg, N s/(m kg): times the lighter mass, the most a pair may have
  float held_stiffness = 0, held_damping = 0;  ///< of the ground, Pa/m, Pa s/m
  float global_damping = 0;                    ///< of eq. 3, kg/(s m^2)
  float shortest = 0, longest = 0;             ///< rest length over distance between which a bond does not yield
};

/// How far bonds reach.
struct Reach {
  float cutoff_squared = 0;  ///< m^2
  float fade_scale = 0;      ///< 1/m^2: over the last tenth of the range, 0.81 to 1 of its square, forces fade
  bool spring = false;       ///< eq. 1 in the place of eq. 6
};

template <class Real>
struct Sum {
  Real x, y, z;
};

/// Where two particles are and move against each other: i less j, but velocities j less i.
template <class Real>
struct Pair {
  Real dx, dy, dz, r_squared, dvx, dvy, dvz;
};

template <class Real>
DIVOT_INLINE Real squared_length(Real x, Real y, Real z) {
  return (x * x + y * y) + z * z;
}

/// Rest length of a bond at the start of a substep: it has yielded where it was strained too far, has formed if the
/// two came into range, at rest as they are, and is gone (0) out of range or unless it `stays`. Below 0 there is no
/// pair.
template <class Real, class Truth>
DIVOT_INLINE Real renewed(const Terms& t, const Reach& reach, Real r_squared, Real r0, Truth stays) {
  using math::both, math::greatest, math::least, math::root, math::select;
  const Real zero = Real(0.0f), r = root(r_squared);
  const Real yielded = least(greatest(r0, r * Real(t.shortest)), r * Real(t.longest));
  const Real bonded = select(both(r_squared < Real(reach.cutoff_squared), stays), select(r0 > zero, yielded, r), zero);
  return select(r0 < zero, r0, bonded);
}

/// Adds cohesion (eq. 6 or 1) and viscous damping (eq. 2) of one bond; nothing where there is none.
template <class Real>
DIVOT_INLINE void add_bond(const Terms& t, const Reach& reach, const Pair<Real>& p, Real r0, Real softened,
                           Real damping, Sum<Real>& sum) {
  using math::both, math::greatest, math::least, math::root, math::select;
  const Real zero = Real(0.0f), one = Real(1.0f);
  const Real cohesion = reach.spring ? laws::mass_spring(t.medium, root(p.r_squared), r0)
                                     : laws::lennard_jones(t.medium, p.r_squared, r0);
  // 1 up to 90 % of the cutoff, then smoothly to 0 at the cutoff: pairs leave and come without a jump.
  const Real s = least(greatest((Real(reach.cutoff_squared) - p.r_squared) * Real(reach.fade_scale), zero), one);
  const Real near = s * s * (Real(3.0f) - Real(2.0f) * s);
  const Real push = near * softened * cohesion, drag = near * damping;
  const auto bonded = both(both(r0 > zero, p.r_squared < Real(reach.cutoff_squared)), p.r_squared > zero);
  sum.x += select(bonded, push * p.dx + drag * p.dvx, zero);
  sum.y += select(bonded, push * p.dy + drag * p.dvy, zero);
  sum.z += select(bonded, push * p.dz + drag * p.dvz, zero);
}

/// Share of a pair's stiffness that a substep can follow, and its damping, by the lighter of the two masses.
template <class Real>
DIVOT_INLINE Real softening(const Terms& t, Real lighter) {
  using math::least;
  return least(Real(1.0f), lighter * Real(t.soften_bonds));
}
template <class Real>
DIVOT_INLINE Real softened_damping(const Terms& t, Real lighter) {
  using math::least;
  return least(Real(t.medium.viscous_damping), lighter * Real(t.soften_damping));
}

/// A free particle against the ground.
template <class Real>
struct Own {
  Real dx, dy, dz;  ///< m, from where its column is at rest
  Real vx, vy, vz, mass, flow_rate, area, plastic;
};

/// Adds eq. 3 and the ground. Soil that a blast has made flow has no skeleton left: it resists by drag alone, in the
/// place of both, until it rests.
template <class Real>
DIVOT_INLINE void add_own(const Terms& t, const Own<Real>& p, Sum<Real>& sum) {
  using math::select;
  const auto flows = p.flow_rate > Real(0.0f);
  const Real gamma = select(flows, p.mass * p.flow_rate, Real(t.global_damping) * p.area);
  Real x = -gamma * p.vx, y = -gamma * p.vy, z = -gamma * p.vz;
  if (t.medium.ground) {
    const laws::Traction<Real> traction = laws::ground_traction<Real>(t.medium, t.held_stiffness, t.held_damping, p.dx,
                                                                      p.dy, p.dz, p.vx, p.vy, p.vz, p.plastic);
    const Real area = select(flows, Real(0.0f), p.area);
    x += area * traction.x, y += area * traction.y, z += area * traction.z;
  }
  sum.x += x, sum.y += y, sum.z += z;
}

}  // namespace divot::forces
