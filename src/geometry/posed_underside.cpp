// Undersides: where a vertical line enters a piece, in its own axes.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/posed_solid.h"

namespace divot::geometry {
namespace {

using Kind = Piece::Kind;

constexpr double kInf = std::numeric_limits<double>::infinity();
// Rays that run along a face or wall this nearly do not cross it.
constexpr double kParallel = 1e-12;

struct Span {
  double begin = -kInf, end = kInf;
  bool empty() const { return begin > end; }
};

// Where `from + t direction` lies between -half and half.
Span slab(double from, double direction, double half) {
  if (std::abs(direction) < kParallel) return std::abs(from) <= half ? Span{} : Span{kInf, -kInf};
  const double a = (-half - from) / direction, b = (half - from) / direction;
  return {std::min(a, b), std::max(a, b)};
}

// Where a t^2 + 2 b t + c <= 0, for a > 0.
Span inside_round(double a, double b, double c) {
  if (a < kParallel) return c <= 0 ? Span{} : Span{kInf, -kInf};
  const double root = b * b - a * c;
  if (root < 0) return {kInf, -kInf};
  const double s = std::sqrt(root);
  return {(-b - s) / a, (-b + s) / a};
}

double axis_of(const Vec3d& v, int i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }

Vec3d unit(int i, double size) { return {i == 0 ? size : 0, i == 1 ? size : 0, i == 2 ? size : 0}; }

}  // namespace

Underside PosedPiece::underside(double x, double y) const {
  if (x < low.x || x > high.x || y < low.y || y > high.y) return {};
  if (piece_->kind == Kind::sphere) return sphere(x, y);
  if (piece_->kind == Kind::capsule) return capsule(x, y);
  const Vec3d from = math::transposed_times(axes_, Vec3d{x - position_.x, y - position_.y, 0});
  switch (piece_->kind) {
    case Kind::box:
      return box(from);
    case Kind::cylinder:
      return cylinder(from);
    case Kind::cone:
      return cone(from);
    default:
      return hull(from);
  }
}

Underside PosedPiece::hit(double rise, const Vec3d& normal) const {
  return {true, position_.z + rise, math::operator*(axes_, normal)};
}

Underside PosedPiece::sphere(double x, double y) const {
  const double r = piece_->radius, dx = x - position_.x, dy = y - position_.y, h_squared = r * r - dx * dx - dy * dy;
  if (h_squared <= 0) return {};
  const double h = std::sqrt(h_squared);
  return {true, position_.z - h, {dx / r, dy / r, -h / r}};
}

Underside PosedPiece::box(const Vec3d& from) const {
  Span inside;
  int entered = 0;
  for (int i = 0; i < 3; ++i) {
    const Span s = slab(axis_of(from, i), axis_of(up_, i), axis_of(piece_->half, i));
    if (s.begin > inside.begin) inside.begin = s.begin, entered = i;
    inside.end = std::min(inside.end, s.end);
  }
  if (inside.empty()) return {};
  return hit(inside.begin, unit(entered, axis_of(up_, entered) > 0 ? -1 : 1));
}

Underside PosedPiece::cylinder(const Vec3d& from) const {
  const double r = piece_->radius;
  const Span wall = inside_round(up_.x * up_.x + up_.z * up_.z, from.x * up_.x + from.z * up_.z,
                                 from.x * from.x + from.z * from.z - r * r);
  const Span ends = slab(from.y, up_.y, piece_->half_length);
  if (wall.empty() || ends.empty() || std::max(wall.begin, ends.begin) > std::min(wall.end, ends.end)) return {};
  if (ends.begin >= wall.begin) return hit(ends.begin, {0, up_.y > 0 ? -1.0 : 1.0, 0});
  const Vec3d at = from + wall.begin * up_;
  return hit(wall.begin, {at.x / r, 0, at.z / r});
}

// The lowest of the two end balls and the tube between them.
Underside PosedPiece::capsule(double x, double y) const {
  const double r = piece_->radius;
  Underside lowest;
  const auto take = [&](double height, const Vec3d& normal) {
    if (!lowest.below || height < lowest.height) lowest = {true, height, normal};
  };
  for (const double side : {-1.0, 1.0}) {
    const Vec3d c = position_ + (side * piece_->half_length) * axis_;
    const double dx = x - c.x, dy = y - c.y, h_squared = r * r - dx * dx - dy * dy;
    if (h_squared <= 0) continue;
    const double h = std::sqrt(h_squared);
    take(c.z - h, {dx / r, dy / r, -h / r});
  }
  const Vec3d from = math::transposed_times(axes_, Vec3d{x - position_.x, y - position_.y, 0});
  const Span wall = inside_round(up_.x * up_.x + up_.z * up_.z, from.x * up_.x + from.z * up_.z,
                                 from.x * from.x + from.z * from.z - r * r);
  if (!wall.empty() && wall.begin > -kInf) {
    const Vec3d at = from + wall.begin * up_;
    if (std::abs(at.y) <= piece_->half_length)
      take(position_.z + wall.begin, math::operator*(axes_, Vec3d{at.x / r, 0, at.z / r}));
  }
  return lowest;
}

// The first of the crossings with wall and base that lies on the cone.
Underside PosedPiece::cone(const Vec3d& from) const {
  const double height = 2 * piece_->half_length, k = piece_->radius / height, w = piece_->half_length - from.z;
  const double a = up_.x * up_.x + up_.y * up_.y - k * k * up_.z * up_.z,
               b = from.x * up_.x + from.y * up_.y + k * k * w * up_.z,
               c = from.x * from.x + from.y * from.y - k * k * w * w;
  std::array<double, 3> crossing = {kInf, kInf, kInf};
  if (std::abs(up_.z) > kParallel) crossing[0] = (-piece_->half_length - from.z) / up_.z;
  const double root = b * b - a * c;
  if (std::abs(a) < kParallel) {
    if (std::abs(b) > kParallel) crossing[1] = -c / (2 * b);
  } else if (root >= 0) {
    crossing[1] = (-b - std::sqrt(root)) / a, crossing[2] = (-b + std::sqrt(root)) / a;
  }
  const double slack = 1e-9 * (height + piece_->radius);
  double first = kInf;
  bool base = false;
  for (int i = 0; i < 3; ++i) {
    if (!(crossing[i] < first)) continue;
    const Vec3d at = from + crossing[i] * up_;
    const double below_tip = piece_->half_length - at.z, wide = k * below_tip + slack;
    if (below_tip < -slack || below_tip > height + slack || at.x * at.x + at.y * at.y > wide * wide) continue;
    first = crossing[i], base = i == 0;
  }
  if (first == kInf) return {};
  if (base) return hit(first, {0, 0, -1});
  const Vec3d at = from + first * up_;
  const double across = std::hypot(at.x, at.y), lean = 1 / std::sqrt(1 + k * k);
  // At the tip the wall has every direction; the axis is their mean.
  const Vec3d normal = across > slack ? Vec3d{at.x / across * lean, at.y / across * lean, k * lean} : Vec3d{0, 0, 1};
  return hit(first, normal);
}

Underside PosedPiece::hull(const Vec3d& from) const {
  Span inside;
  const ConvexHull::Plane* entered = nullptr;
  for (const ConvexHull::Plane& face : piece_->hull->faces) {
    const double along = dot(face.normal, up_), room = face.offset - dot(face.normal, from);
    if (std::abs(along) < kParallel) {
      if (room < 0) return {};
    } else if (along > 0) {
      inside.end = std::min(inside.end, room / along);
    } else if (room / along > inside.begin) {
      inside.begin = room / along, entered = &face;
    }
  }
  if (inside.empty() || entered == nullptr) return {};
  return hit(inside.begin, entered->normal);
}

}  // namespace divot::geometry
