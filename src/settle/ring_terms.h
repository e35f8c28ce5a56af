#pragma once

#include "math/real.h"

// What rings are asked for, for one float or for lanes of eight, so that both give the same bits.
namespace divot::settle {

/// A neighbour as its particle sees it: where it is and how much further it has moved, m.
template <class Real>
struct Spoke {
  Real x, y, z, dx, dy, dz;
};

/// One that is seen at the end of a step as it was halfway through, its way times the root of a
/// twelfth: what add_mean_area() takes.
template <class Real>
DIVOT_INLINE Spoke<Real> halfway(const Spoke<Real>& end) {
  const Real half = Real(0.5f), scale = Real(0.28867513f);  // sqrt(1 / 12)
  return {end.x - half * end.dx, end.y - half * end.dy, end.z - half * end.dz,
          scale * end.dx,        scale * end.dy,        scale * end.dz};
}

template <class Real>
struct Area {
  Real x, y, z;  ///< m^2
};

/// Adds a face's area vector, doubled, as its mean over a step in which all three corners move evenly: with the volumes
/// that particles sweep by it, those of a face's corners sum to what the face sweeps, exactly. Over time the mean of
/// a x b is that of the middles and a twelfth of the ways' own.
template <class Real>
DIVOT_INLINE void add_mean_area(const Spoke<Real>& a, const Spoke<Real>& b, Area<Real>& sum) {
  sum.x += (a.y * b.z - a.z * b.y) + (a.dy * b.dz - a.dz * b.dy);
  sum.y += (a.z * b.x - a.x * b.z) + (a.dz * b.dx - a.dx * b.dz);
  sum.z += (a.x * b.y - a.y * b.x) + (a.dx * b.dy - a.dy * b.dx);
}

/// Volume that vanished below a particle that moved by dx, dy, dz, m^3.
template <class Real>
DIVOT_INLINE Real swept(const Area<Real>& area, Real dx, Real dy, Real dz) {
  return ((area.x * dx + area.y * dy) + area.z * dz) * Real(-1.0f / 6);
}

/// Squares of the slopes from which on there is something to look at.
struct Slopes {
  float face = 0, edge = 0;
  bool edges = false;  ///< some soil has cohesion, for which edges and their excess count
};

/// Is the face between two spokes steeper?
template <class Real>
DIVOT_INLINE auto is_steep_face(const Spoke<Real>& a, const Spoke<Real>& b, const Slopes& slopes) {
  const Real x = a.y * b.z - a.z * b.y, y = a.z * b.x - a.x * b.z, z = a.x * b.y - a.y * b.x;
  return Real(slopes.face) * (z * z) < x * x + y * y;
}
/// Is the edge?
template <class Real>
DIVOT_INLINE auto is_steep_edge(const Spoke<Real>& a, const Slopes& slopes) {
  return Real(slopes.edge) * (a.x * a.x + a.y * a.y) < a.z * a.z;
}

}  // namespace divot::settle
