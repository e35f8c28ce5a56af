#pragma once

#include <optional>
#include <vector>

#include "geometry/solid.h"

namespace divot::geometry {

/// Height of a body's underside over a point, m, and the outward unit normal there.
struct Underside {
  bool below = false;  ///< the body is over this point at all
  double height = 0;
  Vec3d normal;
};

/// A straight line on a round piece along which it touches what it rolls on; a ball's is one point.
struct Ridge {
  Vec3d from, to;
};

/// A part of a square: its area, m^2, and its middle.
struct Cover {
  double area = 0, x = 0, y = 0;
};

/// A convex piece at a place.
class PosedPiece {
 public:
  /// Keeps its memory from call to call. `piece` must outlive it. Only with `outlined` may outside() and covered() be
  /// asked. [O(1); O(corners) for a hull]
  void place(const Piece& piece, const Vec3d& position, const math::Matrix3& axes, bool outlined);

  /// [O(1); O(faces) for a hull]
  Underside underside(double x, double y) const;

  /// How far x, y lies outside the outline of the piece as seen from below, m; negative inside. `away` is the unit
  /// direction in which it is left. [O(1); O(edges) for a hull]
  double outside(double x, double y, Vec3d& away) const;

  /// The part of the square of side `width` round x, y that lies inside the outline. [likewise]
  Cover covered(double x, double y, double width) const;

  /// The line that touches a plane with the upward unit normal `up` when the piece rolls on it; nothing for pieces that
  /// do not roll, or not on that plane.
  std::optional<Ridge> ridge(const Vec3d& up) const;

  /// Mean of what is lowest, sharp for what stands tilted, the middle for a face that lies level.
  Vec3d lowest() const;

  const Piece& piece() const { return *piece_; }
  Vec3d low, high;  ///< corners of the upright box around it, m

 private:
  struct Line {
    double x, y, offset;  // unit normal outward; x, y on it: x * px + y * py = offset
  };
  Underside sphere(double x, double y) const;
  Underside box(const Vec3d& from) const;
  Underside cylinder(const Vec3d& from) const;
  Underside capsule(double x, double y) const;
  Underside cone(const Vec3d& from) const;
  Underside hull(const Vec3d& from) const;
  Underside hit(double rise, const Vec3d& normal) const;
  void add_line(double nx, double ny, double reach);
  void find_outline();
  void find_bounds();

  const Piece* piece_ = nullptr;
  Vec3d position_;
  math::Matrix3 axes_;
  Vec3d axis_;                 // of a round piece, in the world
  Vec3d up_;                   // the world's z in the piece's axes
  std::vector<Line> outline_;  // of pieces that are not round from below: sphere and capsule need none
};

/// A solid at a place: what columns of soil ask.
class PosedSolid {
 public:
  /// Keeps its memory from call to call. `solid` must outlive it.
  void place(const Solid& solid, const Vec3d& position, const Quat& orientation, bool outlined = false);

  /// Of the lowest piece over x, y.
  Underside underside(double x, double y) const;

  /// Could it touch a point that comes nearer by `reach`, m?
  bool within_reach(const Vec3& p, double reach) const;
  /// The same from above: is x, y within `reach` of its shadow's box?
  bool over(double x, double y, double reach) const {
    return x >= low_.x - reach && x <= high_.x + reach && y >= low_.y - reach && y <= high_.y + reach;
  }

  const std::vector<PosedPiece>& pieces() const { return pieces_; }
  Vec3d position() const { return position_; }
  Vec3d low() const { return low_; }
  Vec3d high() const { return high_; }

 private:
  std::vector<PosedPiece> pieces_;
  Vec3d position_, low_, high_;
  bool ball_ = false;
  double radius_ = 0;
};

/// Speed at which the shape's surface moves when it spins with w, rad/s, at most, m/s: none for what turns about an
/// axis of symmetry.
double sweep_speed(const Solid& solid, const Quat& orientation, const Vec3d& w);

}  // namespace divot::geometry
