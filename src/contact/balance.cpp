#include "contact/balance.h"

#include <algorithm>
#include <cmath>

namespace divot::contact {
namespace {

// Soil before a wall resists with all its strength from this speed on, m/s; a wall that rests there feels nothing.
constexpr double kPushed = 0.01;

// Joints pull with this many times the inertia that a body has along their lines.
constexpr double kGuide = 10;

constexpr int kIterations = 40, kHalvings = 12;

using math::add_outer;
using math::add_scaled;
using math::Matrix6;
using math::times;

}  // namespace

Matrix6 inertia_of(const state::Body& body) {
  Matrix6 m{};
  for (int i = 0; i < 3; ++i) m[i][i] = body.mass;
  const Vec3d i = body.inertia;
  if (i.x == i.y && i.y == i.z) {
    for (int k = 3; k < 6; ++k) m[k][k] = i.x;
    return m;
  }
  const math::Matrix3 r = math::matrix_of(body.orientation);
  for (int row = 0; row < 3; ++row)
    for (int c = 0; c <= row; ++c)
      m[3 + row][3 + c] = r[row].x * i.x * r[c].x + r[row].y * i.y * r[c].y + r[row].z * i.z * r[c].z;
  return m;
}

double Balance::weight_of(const Guide& guide) const {
  Matrix6 factor = inertia;
  Row response = guide.line;
  solve(factor, response);
  return kGuide / dot6(guide.line, response);
}

Row Balance::missing(const Row& v, Matrix6* a) const {
  Row r = times(inertia, moved(start, v, -1));
  if (a != nullptr) *a = inertia;
  for (const Guide& guide : guides) {
    const double weight = weight_of(guide);
    add_scaled(r, guide.line, weight * (guide.speed - dot6(guide.line, v)));
    if (a != nullptr) add_outer(*a, guide.line, weight);
  }
  for (const Wall& wall : walls) {
    const double inward = dot6(wall.inward, v);
    if (inward <= 0) continue;
    add_scaled(r, wall.inward, -s.dt * wall.force * std::min(1.0, inward / kPushed));
    if (a != nullptr && inward < kPushed) add_outer(*a, wall.inward, s.dt * wall.force / kPushed);
  }
  std::copy(v.begin(), v.end(), task.v);
  ColumnSums sums;
  const auto add = a != nullptr ? fastest_columns().add : fastest_columns().add_force;
  add(task, columns.data(), columns.size(), sums);
  const auto sum = [](const ColumnBlock::Four& x) { return (x[0] + x[1]) + (x[2] + x[3]); };
  for (int k = 0; k < 6; ++k) r[k] += s.dt * sum(sums.force[k]);
  if (a != nullptr)
    for (int row = 0, at = 0; row < 6; ++row)
      for (int c = 0; c <= row; ++c, ++at) (*a)[row][c] += s.dt * sum(sums.slope[at]);
  return r;
}

// `missing` is the function's negative gradient, so a step that still goes downhill at its end is taken whole, and what
// was found there starts the next one; a step that overshoots is cut where the slope along it changes sign.
Matrix6 find_balance(const Balance& balance, double exact, Row& v) {
  const double still = exact / balance.s.dt;
  Matrix6 a;
  Row missing = balance.missing(v, &a);
  Matrix6 slope{};
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Row downhill = missing;
    Row step = missing;
    slope = a;
    solve(a, step);
    const double speed = std::sqrt(step[0] * step[0] + step[1] * step[1] + step[2] * step[2]) +
                         balance.body.radius * std::sqrt(step[3] * step[3] + step[4] * step[4] + step[5] * step[5]);
    const Row whole = moved(v, step, 1);
    if (speed < still) {
      v = whole;
      break;
    }
    missing = balance.missing(whole, &a);
    if (dot6(missing, step) >= -0.1 * dot6(downhill, step)) {
      v = whole;
      continue;
    }
    double low = 0, high = 1;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (low + high);
      (dot6(balance.missing(moved(v, step, middle), nullptr), step) > 0 ? low : high) = middle;
    }
    v = moved(v, step, low > 0 ? low : high);
    missing = balance.missing(v, &a);
  }
  return slope;
}

}  // namespace divot::contact
