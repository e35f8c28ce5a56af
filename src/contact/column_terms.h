#pragma once

#include "contact/columns.h"
#include "laws/bekker.h"
#include "math/real.h"

// One column's part in a body's balance, for one double or for lanes of four, so that both give the same bits.
namespace divot::contact {

// Flanks steeper than this push sideways no harder: at the equator of a ball the vertical columns would push
// infinitely.
inline constexpr double kSteepestFlank = 0.25;  // |vertical part of the normal|

template <class Real>
struct RealRow {
  Real x, y, z, spin_x, spin_y, spin_z;
  DIVOT_INLINE explicit RealRow(const double* v)
      : x(v[0]), y(v[1]), z(v[2]), spin_x(v[3]), spin_y(v[4]), spin_z(v[5]) {}
};

template <class Real>
struct Vec3Of {
  Real x, y, z;
};
template <class Real>
DIVOT_INLINE Vec3Of<Real> cross_of(const Vec3Of<Real>& a, const Vec3Of<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Geometry of a column for a body that is over it with the underside and normal in the block.
template <class Real, class In>
DIVOT_INLINE void freeze_column(const ColumnTask& task, const laws::Medium& medium, const RealRow<Real>& v, const In in,
                                ColumnBlock& b) {
  using math::greatest, math::least, math::root, math::select;
  const Real zero = Real(0.0), one = Real(1.0);
  const Real underside = in.get(b.underside);
  const auto below = underside < Real(ColumnBlock::kNotBelow);
  const Vec3Of<Real> normal{in.get(b.normal[0]), in.get(b.normal[1]), in.get(b.normal[2])};
  const Vec3Of<Real> arm{in.get(b.arm_at_x) - Real(task.position.x), in.get(b.arm_at_y) - Real(task.position.y),
                         select(below, underside - Real(task.position.z), zero)};
  const Real per_steep = one / greatest(-normal.z, Real(kSteepestFlank));
  const Vec3Of<Real> push{-normal.x * per_steep, -normal.y * per_steep, one};
  const Vec3Of<Real> turn = cross_of(arm, push);
  const Real rise_there =
      push.x * v.x + push.y * v.y + v.z + (turn.x * v.spin_x + turn.y * v.spin_y + turn.z * v.spin_z);
  const Real slope = root(push.x * push.x + push.y * push.y + one);

  // Slip is against soil that goes down with the body, but stays where it is while the body only moves along. Were it
  // to follow the underside of a wheel that rolls by, that would grip while it turns too fast, and never skid.
  const Real size = root(normal.z * normal.z + normal.x * normal.x);
  const auto lies = size > Real(1e-6);
  const Real per_size = one / select(lies, size, one);
  const Vec3Of<Real> tangent{select(lies, -normal.z * per_size, one), zero, select(lies, normal.x * per_size, zero)};
  const Vec3Of<Real> other = cross_of(normal, tangent);
  const auto set_slip = [&](const Vec3Of<Real>& along, ColumnBlock::Four(&slip)[5]) DIVOT_INLINE_LAMBDA {
    const Vec3Of<Real> spin = cross_of(arm, along);
    in.set(slip[0], along.x - along.z * Real(task.ground.x));
    in.set(slip[1], along.y - along.z * Real(task.ground.y));
    in.set(slip[2], spin.x - along.z * turn.x);
    in.set(slip[3], spin.y - along.z * turn.y);
    in.set(slip[4], spin.z - along.z * turn.z);
  };
  set_slip(tangent, b.slip), set_slip(other, b.other_slip);

  // The soil's strength or the body's own friction.
  const Real load = select(below, in.get(b.load), zero), area = in.get(b.area);
  const Real strength = laws::shear_strength(medium, load / area) * (area * slope);
  in.set(b.grip, select(load > zero, least(strength, Real(task.friction) * load * slope), zero));
  in.set(b.arm[0], arm.x), in.set(b.arm[1], arm.y), in.set(b.arm[2], arm.z);
  in.set(b.rise[0], push.x), in.set(b.rise[1], push.y);
  in.set(b.turn[0], turn.x), in.set(b.turn[1], turn.y), in.set(b.turn[2], turn.z);
  in.set(b.rise_there, rise_there), in.set(b.slope, slope);
  in.set(b.tangent[0], tangent.x), in.set(b.tangent[1], tangent.z);
  in.set(b.other[0], other.x), in.set(b.other[1], other.y), in.set(b.other[2], other.z);
}

/// Of the underside's speed, upward, what spin makes.
template <class Real, class In>
DIVOT_INLINE Real turning_of(const RealRow<Real>& v, const In in, const ColumnBlock& b) {
  return in.get(b.turn[0]) * v.spin_x + in.get(b.turn[1]) * v.spin_y + in.get(b.turn[2]) * v.spin_z;
}
template <class Real, class In>
DIVOT_INLINE Real rising_of(const RealRow<Real>& v, Real turning, const In in, const ColumnBlock& b) {
  return in.get(b.rise[0]) * v.x + in.get(b.rise[1]) * v.y + v.z + turning;
}

/// Height of the underside at the end of the step, m.
template <class Real, class In>
DIVOT_INLINE Real height_of(const ColumnTask& task, const RealRow<Real>& v, const In in, const ColumnBlock& b) {
  const Real rising = rising_of(v, turning_of(v, in, b), in, b);
  return in.get(b.underside) + Real(task.dt) * (rising - in.get(b.rise_there));
}

/// A column's vertical push, N, >= 0, and how fast it falls with the speed at which the underside rises and with that
/// at which the body lifts off the ground, N s/m.
template <class Real>
struct Push {
  Real force, per_rising, per_lifting;
};
template <class Real, class In>
DIVOT_INLINE Push<Real> push_of(const ColumnTask& task, const laws::Medium& medium, const RealRow<Real>& v, const In in,
                                const ColumnBlock& b) {
  using math::both, math::least, math::select;
  const Real zero = Real(0.0), dt = Real(task.dt);
  const Real turning = turning_of(v, in, b), rising = rising_of(v, turning, in, b);
  const auto touches = height_of(task, v, in, b) < in.get(b.height);
  if (!medium.ground) {
    // A sheet of particles without ground: their own inertia, and their bonds. A particle that a body carries already
    // moves with it; others are met at their own speed. It does not pull.
    const Real inertia = in.get(b.mass) / dt;
    const RealRow<Real> now(task.now);
    const Real carried = rising_of(now, turning_of(now, in, b), in, b);
    const Real met = select(in.get(b.carried) > zero, carried, in.get(b.speed));
    const Real force = in.get(b.pull) + inertia * (met - rising);
    const auto pushes = both(touches, force > zero);
    return {select(pushes, force, zero), select(pushes, inertia, zero), zero};
  }
  // Bekker's pressure, as it was measured, has in it what holds soil together at the patch's edge: bonds do not count.
  // A load that only moves along, slower than waves, radiates none.
  const Real lifting = Real(task.ground.x) * v.x + Real(task.ground.y) * v.y + v.z + turning;
  const Real slope = in.get(b.slope), area = in.get(b.area);
  const auto pressure = laws::ground_pressure<Real>(medium, in.get(b.fresh) - height_of(task, v, in, b),
                                                    in.get(b.plastic), Real(task.patch), Real(medium.elastic_stiffness),
                                                    least(-rising, -lifting), -rising / slope);
  const Real force = pressure.value * area;
  const Real base = (pressure.slope * dt + pressure.throwing / slope) * area, damping = pressure.damping * area;
  const auto pushes = both(touches, force > zero), rises = rising > lifting;
  return {select(pushes, force, zero), select(pushes, base + select(rises, damping, zero), zero),
          select(pushes, select(rises, zero, damping), zero)};
}

/// Shear displacement of a column at the end of the step, m, along both tangents.
template <class Real>
struct Slip {
  Real along, across;
};
template <class Real, class In>
DIVOT_INLINE Slip<Real> slip_of(const ColumnTask& task, const RealRow<Real>& v, const In in, const ColumnBlock& b) {
  const auto speed = [&](const ColumnBlock::Four(&row)[5]) DIVOT_INLINE_LAMBDA {
    return in.get(row[0]) * v.x + in.get(row[1]) * v.y +
           (in.get(row[2]) * v.spin_x + in.get(row[3]) * v.spin_y + in.get(row[4]) * v.spin_z);
  };
  const Real x = in.get(b.shear[0]), y = in.get(b.shear[1]), z = in.get(b.shear[2]), dt = Real(task.dt);
  return {x * in.get(b.tangent[0]) + z * in.get(b.tangent[1]) + dt * speed(b.slip),
          x * in.get(b.other[0]) + y * in.get(b.other[1]) + z * in.get(b.other[2]) + dt * speed(b.other_slip)};
}

/// A column's shear force along both tangents, against the slip, N; its slope, N/m, along the shear displacement and
/// across it.
template <class Real>
struct Shear {
  Real force, other_force;
  Real along, across;  ///< unit, direction of the shear displacement
  Real tangent, secant;
};
template <class Real, class In>
DIVOT_INLINE Shear<Real> shear_of(const ColumnTask& task, const laws::Medium& medium, const RealRow<Real>& v,
                                  const In in, const ColumnBlock& b) {
  using math::least, math::root, math::select;
  const Real zero = Real(0.0), one = Real(1.0), grip = in.get(b.grip);
  const Slip<Real> j = slip_of(task, v, in, b);
  const Real size = root(j.along * j.along + j.across * j.across);
  const auto sheared = size > zero;
  const Real per_size = one / select(sheared, size, one), per_modulus = Real(1.0 / medium.shear_modulus);
  // Force by Janosi-Hanamoto; beyond the displacement at which the soil slides it stays the same.
  const Real most = Real(double{laws::kSlideShear} * medium.shear_modulus);
  const Real share = laws::mobilised_shear<Real>(medium, least(size, most)), whole = grip * share;
  const Real along = select(sheared, j.along * per_size, one), across = select(sheared, j.across * per_size, zero);
  return {whole * along,
          whole * across,
          along,
          across,
          select(size < most, grip * (one - share) * per_modulus, zero),
          select(sheared, whole * per_size, grip * per_modulus)};
}

/// Sums as in ColumnSums.
template <class Real>
struct RealSums {
  Real force[6], slope[21];
};

template <bool kSlope, class Real, class In>
DIVOT_INLINE void add_column(const ColumnTask& task, const laws::Medium& medium, const RealRow<Real>& v, const In in,
                             const ColumnBlock& b, RealSums<Real>& sums) {
  using math::any, math::either, math::select;
  const Real zero = Real(0.0), grip = in.get(b.grip);
  // A third of what is in a ball's reach is neither touched nor sheared.
  if (!any(either(height_of(task, v, in, b) < in.get(b.height), grip > zero))) return;
  const Push<Real> push = push_of(task, medium, v, in, b);
  const Shear<Real> shear = shear_of(task, medium, v, in, b);
  const Real held = select(grip > zero, in.get(b.held), zero), lift = push.force + held;
  const Real rise[2] = {in.get(b.rise[0]), in.get(b.rise[1])};
  const Real turn[3] = {in.get(b.turn[0]), in.get(b.turn[1]), in.get(b.turn[2])};
  const Real ground[2] = {Real(task.ground.x), Real(task.ground.y)};
  Real slip[5], other[5];
  for (int k = 0; k < 5; ++k) slip[k] = in.get(b.slip[k]), other[k] = in.get(b.other_slip[k]);
  for (int k = 0; k < 2; ++k)
    sums.force[k] += push.force * rise[k] + held * ground[k] - (shear.force * slip[k] + shear.other_force * other[k]);
  sums.force[2] += lift;
  for (int k = 0; k < 3; ++k)
    sums.force[3 + k] += lift * turn[k] - (shear.force * slip[2 + k] + shear.other_force * other[2 + k]);
  if constexpr (kSlope) {
    // Shear falls by `tangent` along its displacement and by `secant` across, per way.
    const Real dt = Real(task.dt), t = dt * shear.tangent, s = dt * shear.secant;
    const Real xx = t * shear.along * shear.along + s * shear.across * shear.across,
               xy = (t - s) * shear.along * shear.across,
               yy = t * shear.across * shear.across + s * shear.along * shear.along;
    // Rows of six, as the columns of a matrix: what of a row is 0 adds nothing, what is 1 is not multiplied with.
    const Real both_ways = push.per_rising + push.per_lifting;
    Real pushed[2];
    for (int k = 0; k < 2; ++k) pushed[k] = push.per_rising * rise[k] + push.per_lifting * ground[k];
    Real sheared[5], other_sheared[5];
    for (int k = 0; k < 5; ++k)
      sheared[k] = xx * slip[k] + xy * other[k], other_sheared[k] = xy * slip[k] + yy * other[k];
    const auto shear_at = [&](int r, int c)
                              DIVOT_INLINE_LAMBDA { return sheared[r] * slip[c] + other_sheared[r] * other[c]; };
    int at = 0;
    for (int r = 0; r < 2; ++r)
      for (int c = 0; c <= r; ++c)
        sums.slope[at++] +=
            push.per_rising * rise[r] * rise[c] + push.per_lifting * ground[r] * ground[c] + shear_at(r, c);
    sums.slope[at++] += pushed[0];
    sums.slope[at++] += pushed[1];
    sums.slope[at++] += both_ways;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 2; ++c) sums.slope[at++] += turn[r] * pushed[c] + shear_at(2 + r, c);
      const Real turned = both_ways * turn[r];
      sums.slope[at++] += turned;
      for (int c = 0; c <= r; ++c) sums.slope[at++] += turned * turn[c] + shear_at(2 + r, 2 + c);
    }
  }
}

template <class Real, class In>
DIVOT_INLINE void load_column(const ColumnTask& task, const laws::Medium& medium, const RealRow<Real>& v, const In in,
                              ColumnBlock& b) {
  in.set(b.load, push_of(task, medium, v, in, b).force);
  const Shear<Real> shear = shear_of(task, medium, v, in, b);
  // What shear along the underside's flank carries of the body: that under a driven wheel lifts it.
  in.set(b.held, -(shear.force * in.get(b.tangent[1])) - shear.other_force * in.get(b.other[2]));
}

template <class Real, class In>
DIVOT_INLINE void end_column(const ColumnTask& task, const laws::Medium& medium, const RealRow<Real>& v, const In in,
                             ColumnBlock& b) {
  using math::greatest, math::root, math::select;
  const Real zero = Real(0.0), one = Real(1.0), plastic = in.get(b.plastic);
  const Real sinkage = in.get(b.fresh) - height_of(task, v, in, b);
  if (medium.ground) {
    const auto pressure =
        laws::ground_pressure<Real>(medium, sinkage, plastic, Real(task.patch), Real(medium.elastic_stiffness));
    const Real rest = sinkage - pressure.value / Real(medium.elastic_stiffness);
    in.set(b.end_pressure, pressure.value);
    in.set(b.end_plastic, select(pressure.yields, greatest(plastic, rest), plastic));
  } else {
    in.set(b.end_pressure, zero), in.set(b.end_plastic, plastic);
  }
  // Beyond the displacement at which the soil slides the rest is slip.
  const Slip<Real> j = slip_of(task, v, in, b);
  const Real size = root(j.along * j.along + j.across * j.across);
  const Real most = Real(double{laws::kSlideShear} * medium.shear_modulus);
  const Real kept = select(in.get(b.load) > zero, select(size > most, most / greatest(size, most), one), zero);
  const Real along = kept * j.along, across = kept * j.across;
  in.set(b.end_shear[0], along * in.get(b.tangent[0]) + across * in.get(b.other[0]));
  in.set(b.end_shear[1], across * in.get(b.other[1]));
  in.set(b.end_shear[2], along * in.get(b.tangent[1]) + across * in.get(b.other[2]));
}

}  // namespace divot::contact
