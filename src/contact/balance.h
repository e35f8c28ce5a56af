#pragma once

#include <span>
#include <vector>

#include "contact/columns.h"
#include "contact/contact.h"
#include "contact/joint_rows.h"

namespace divot::contact {

/// Solves A x = b for a symmetric A, of which the lower half is read and lost; x comes in b.
inline void solve(math::Matrix6& a, math::Row& b) {
  math::factorize(a);
  math::solve_factored(a, b);
}

/// v + share direction.
inline math::Row moved(const math::Row& v, const math::Row& direction, double share) {
  math::Row out = v;
  math::add_scaled(out, direction, share);
  return out;
}

/// Mass and moments of inertia in the world's axes, kg and kg m^2: the lower half.
math::Matrix6 inertia_of(const state::Body& body);

/// The six balances of momentum of a body on columns that stay where they are.
struct Balance {
  const state::Body& body;
  const std::vector<ColumnBlock>& columns;
  ColumnTask& task;
  const std::vector<Wall>& walls;
  const Situation& s;
  math::Row start;        ///< velocity and spin with gravity and without soil, m/s, rad/s
  math::Matrix6 inertia;  ///< lower half
  std::span<const Guide> guides;

  /// Of a guide, kg: so stiff that the body's own inertia gives way to it.
  double weight_of(const Guide& guide) const;
  /// What is missing in each balance at the velocities `v`, N s and N m s; with `slope`, its slope's negative as well.
  math::Row missing(const math::Row& v, math::Matrix6* slope) const;
};

/// Newton's method on a convex function, from `v` on and into it. Newton's error falls with the square of its step:
/// `exact`, m, is how far the last one may take the body. Returns the slope's negative where that started, lower half.
/// [O(iterations x columns)]
math::Matrix6 find_balance(const Balance& balance, double exact, math::Row& v);

}  // namespace divot::contact
