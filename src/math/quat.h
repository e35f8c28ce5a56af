#pragma once

#include <array>
#include <cmath>

#include "divot/vec.h"

namespace divot::math {

/// Rows of a rotation: world = matrix * local.
using Matrix3 = std::array<Vec3d, 3>;

inline Matrix3 matrix_of(const Quat& q) {
  const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z, xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z,
               wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  return {Vec3d{1 - 2 * (yy + zz), 2 * (xy - wz), 2 * (xz + wy)},
          Vec3d{2 * (xy + wz), 1 - 2 * (xx + zz), 2 * (yz - wx)},
          Vec3d{2 * (xz - wy), 2 * (yz + wx), 1 - 2 * (xx + yy)}};
}

inline Vec3d operator*(const Matrix3& m, const Vec3d& v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }

/// The transposed matrix times v: from the world into local axes.
inline Vec3d transposed_times(const Matrix3& m, const Vec3d& v) { return v.x * m[0] + v.y * m[1] + v.z * m[2]; }

inline Vec3d column(const Matrix3& m, int i) {
  const auto at = [i](const Vec3d& row) { return i == 0 ? row.x : i == 1 ? row.y : row.z; };
  return {at(m[0]), at(m[1]), at(m[2])};
}

inline Quat conjugate(const Quat& q) { return {-q.x, -q.y, -q.z, q.w}; }

/// First b, then a.
inline Quat operator*(const Quat& a, const Quat& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

inline Quat normalized(const Quat& q) {
  const double l = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return l > 0 ? Quat{q.x / l, q.y / l, q.z / l, q.w / l} : Quat{};
}

inline Vec3d rotate(const Quat& q, const Vec3d& v) {
  const Vec3d u{q.x, q.y, q.z};
  return v + 2 * (q.w * cross(u, v) + cross(u, cross(u, v)));
}

/// The orientation after spinning with w, rad/s, for dt, s.
inline Quat spun(const Quat& q, const Vec3d& w, double dt) {
  const double rate = length(w), half = 0.5 * rate * dt;
  if (half == 0) return q;
  const Vec3d u = w * (std::sin(half) / rate);
  return normalized(Quat{u.x, u.y, u.z, std::cos(half)} * q);
}

/// The rotation whose matrix has these columns, right-handed and unit.
inline Quat from_columns(const Vec3d& x, const Vec3d& y, const Vec3d& z) {
  const double trace = x.x + y.y + z.z;
  if (trace > 0) {
    const double s = 0.5 / std::sqrt(trace + 1);
    return normalized(Quat{(y.z - z.y) * s, (z.x - x.z) * s, (x.y - y.x) * s, 0.25 / s});
  }
  if (x.x > y.y && x.x > z.z) {
    const double s = 2 * std::sqrt(1 + x.x - y.y - z.z);
    return normalized(Quat{0.25 * s, (y.x + x.y) / s, (z.x + x.z) / s, (y.z - z.y) / s});
  }
  if (y.y > z.z) {
    const double s = 2 * std::sqrt(1 + y.y - x.x - z.z);
    return normalized(Quat{(y.x + x.y) / s, 0.25 * s, (z.y + y.z) / s, (z.x - x.z) / s});
  }
  const double s = 2 * std::sqrt(1 + z.z - x.x - y.y);
  return normalized(Quat{(z.x + x.z) / s, (z.y + y.z) / s, 0.25 * s, (x.y - y.x) / s});
}

}  // namespace divot::math
