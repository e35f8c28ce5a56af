#pragma once

#include <cmath>

namespace divot {

/// Three floats: a position in metres relative to a world's origin, or a direction, velocity or force.
struct Vec3 {
  float x = 0;  ///< first component
  float y = 0;  ///< second component
  float z = 0;  ///< third component

  /// @{
  /// Component by component.
  Vec3& operator+=(const Vec3& b) {
    x += b.x, y += b.y, z += b.z;
    return *this;
  }
  Vec3& operator-=(const Vec3& b) {
    x -= b.x, y -= b.y, z -= b.z;
    return *this;
  }
  Vec3& operator*=(float s) {
    x *= s, y *= s, z *= s;
    return *this;
  }
  friend Vec3 operator+(Vec3 a, const Vec3& b) { return a += b; }
  friend Vec3 operator-(Vec3 a, const Vec3& b) { return a -= b; }
  friend Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend Vec3 operator*(Vec3 a, float s) { return a *= s; }
  friend Vec3 operator*(float s, Vec3 a) { return a *= s; }
  friend bool operator==(const Vec3&, const Vec3&) = default;
  /// @}
};

inline float dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(const Vec3& a) { return std::sqrt(dot(a, a)); }
/// The unit vector along `a`; zero stays zero.
inline Vec3 normalized(const Vec3& a) {
  const float l = length(a);
  return l > 0 ? a * (1 / l) : Vec3{};
}
inline bool is_finite(const Vec3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

/// Three doubles: a position in metres in the terrain's own coordinate system (an easting can be 4,000,000 m).
struct Vec3d {
  double x = 0;  ///< first component
  double y = 0;  ///< second component
  double z = 0;  ///< third component

  /// @{
  /// Component by component.
  Vec3d& operator+=(const Vec3d& b) {
    x += b.x, y += b.y, z += b.z;
    return *this;
  }
  Vec3d& operator-=(const Vec3d& b) {
    x -= b.x, y -= b.y, z -= b.z;
    return *this;
  }
  Vec3d& operator*=(double s) {
    x *= s, y *= s, z *= s;
    return *this;
  }
  friend Vec3d operator+(Vec3d a, const Vec3d& b) { return a += b; }
  friend Vec3d operator-(Vec3d a, const Vec3d& b) { return a -= b; }
  friend Vec3d operator-(const Vec3d& a) { return {-a.x, -a.y, -a.z}; }
  friend Vec3d operator*(Vec3d a, double s) { return a *= s; }
  friend Vec3d operator*(double s, Vec3d a) { return a *= s; }
  friend bool operator==(const Vec3d&, const Vec3d&) = default;
  /// @}
};

inline double dot(const Vec3d& a, const Vec3d& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3d cross(const Vec3d& a, const Vec3d& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec3d& a) { return std::sqrt(dot(a, a)); }
inline bool is_finite(const Vec3d& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }
inline Vec3d to_double(const Vec3& a) { return {a.x, a.y, a.z}; }
inline Vec3 to_float(const Vec3d& a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}

/// Unit quaternion of a rotation, identity by default.
struct Quat {
  double x = 0;                                                ///< of the vector part
  double y = 0;                                                ///< of the vector part
  double z = 0;                                                ///< of the vector part
  double w = 1;                                                ///< the real part
  friend bool operator==(const Quat&, const Quat&) = default;  ///< component by component
};

}  // namespace divot
