#pragma once

#include <array>
#include <cmath>

#include "divot/vec.h"

namespace divot::math {

/// Velocity and spin of a body, or what acts on them.
using Row = std::array<double, 6>;
/// Symmetric, given by its lower half.
using Matrix6 = std::array<Row, 6>;

inline Row row(const Vec3d& a, const Vec3d& b) { return {a.x, a.y, a.z, b.x, b.y, b.z}; }
inline Vec3d linear(const Row& r) { return {r[0], r[1], r[2]}; }
inline Vec3d angular(const Row& r) { return {r[3], r[4], r[5]}; }

inline double dot6(const Row& a, const Row& b) {
  double sum = 0;
  for (int i = 0; i < 6; ++i) sum += a[i] * b[i];
  return sum;
}

inline void add_scaled(Row& to, const Row& row, double factor) {
  for (int i = 0; i < 6; ++i) to[i] += factor * row[i];
}

inline void add_outer(Matrix6& to, const Row& row, double factor) {
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c <= r; ++c) to[r][c] += factor * row[r] * row[c];
}

inline Row times(const Matrix6& a, const Row& x) {
  Row out{};
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 6; ++c) out[r] += (c <= r ? a[r][c] : a[c][r]) * x[c];
  return out;
}

/// Replaces a positive definite matrix by the lower half of its Cholesky factor.
inline void factorize(Matrix6& a) {
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (int k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
      a[i][j] = i == j ? std::sqrt(sum) : sum / a[j][j];
    }
  }
}

/// Solves A x = b for the factor of A; x comes in b.
inline void solve_factored(const Matrix6& factor, Row& b) {
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < i; ++k) b[i] -= factor[i][k] * b[k];
    b[i] /= factor[i][i];
  }
  for (int i = 5; i >= 0; --i) {
    for (int k = i + 1; k < 6; ++k) b[i] -= factor[k][i] * b[k];
    b[i] /= factor[i][i];
  }
}

}  // namespace divot::math
