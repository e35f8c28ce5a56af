#include "geometry/posed_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace divot::geometry {
namespace {

using Kind = Piece::Kind;
using math::Matrix3;

constexpr double kInf = std::numeric_limits<double>::infinity();
// Rays that run along a face or wall this nearly do not cross it.
constexpr double kParallel = 1e-12;
// Lines around an ellipse: an outline of so many tangents is 0.2 % too wide at its corners.
constexpr int kTangents = 48;

// Unit vectors all round, in equal steps.
const std::array<std::array<double, 2>, kTangents>& directions() {
  static const auto all = [] {
    std::array<std::array<double, 2>, kTangents> list{};
    for (int k = 0; k < kTangents; ++k) {
      const double angle = 2 * std::numbers::pi * k / kTangents;
      list[static_cast<std::size_t>(k)] = {std::cos(angle), std::sin(angle)};
    }
    return list;
  }();
  return all;
}

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

void PosedPiece::place(const Piece& piece, const Vec3d& position, const Matrix3& axes, bool outlined) {
  piece_ = &piece, position_ = position, axes_ = axes, up_ = axes[2];
  axis_ = math::column(axes, piece.kind == Kind::cone ? 2 : 1);
  find_bounds();
  outline_.clear();
  if (outlined) find_outline();
}

void PosedPiece::find_bounds() {
  const Piece& p = *piece_;
  Vec3d reach;
  const auto round = [&](double along) { return p.radius * std::sqrt(std::max(0.0, 1 - along * along)); };
  switch (p.kind) {
    case Kind::sphere:
      reach = {p.radius, p.radius, p.radius};
      break;
    case Kind::box: {
      const auto one = [&](const Vec3d& row) {
        return std::abs(row.x) * p.half.x + std::abs(row.y) * p.half.y + std::abs(row.z) * p.half.z;
      };
      reach = {one(axes_[0]), one(axes_[1]), one(axes_[2])};
      break;
    }
    case Kind::cylinder: {
      const auto one = [&](double along) { return std::abs(along) * p.half_length + round(along); };
      reach = {one(axis_.x), one(axis_.y), one(axis_.z)};
      break;
    }
    case Kind::capsule: {
      const auto one = [&](double along) { return std::abs(along) * p.half_length + p.radius; };
      reach = {one(axis_.x), one(axis_.y), one(axis_.z)};
      break;
    }
    case Kind::cone: {
      const Vec3d tip = position_ + p.half_length * axis_, base = position_ - p.half_length * axis_;
      const Vec3d r{round(axis_.x), round(axis_.y), round(axis_.z)};
      low = {std::min(tip.x, base.x - r.x), std::min(tip.y, base.y - r.y), std::min(tip.z, base.z - r.z)};
      high = {std::max(tip.x, base.x + r.x), std::max(tip.y, base.y + r.y), std::max(tip.z, base.z + r.z)};
      return;
    }
    case Kind::hull: {
      low = {kInf, kInf, kInf}, high = {-kInf, -kInf, -kInf};
      for (const Vec3d& corner : p.hull->corners) {
        const Vec3d c = position_ + math::operator*(axes_, corner);
        low = {std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z)};
        high = {std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z)};
      }
      return;
    }
  }
  low = position_ - reach, high = position_ + reach;
}

// ---- underside: where a vertical line enters the piece, in its own axes

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

// ---- outline: what a piece covers, seen from below

void PosedPiece::add_line(double nx, double ny, double reach) {
  outline_.push_back({nx, ny, nx * position_.x + ny * position_.y + reach});
}

void PosedPiece::find_outline() {
  const Piece& p = *piece_;
  if (p.kind == Kind::box) {
    // The shadow of a box is a hexagon whose sides are shadows of its edges.
    for (int i = 0; i < 3; ++i) {
      const Vec3d edge = math::column(axes_, i);
      const double size = std::hypot(edge.x, edge.y);
      if (size < 1e-9) continue;
      const double nx = edge.y / size, ny = -edge.x / size;
      double reach = 0;
      for (int k = 0; k < 3; ++k) {
        const Vec3d other = math::column(axes_, k);
        reach += std::abs(nx * other.x + ny * other.y) * axis_of(p.half, k);
      }
      add_line(nx, ny, reach), add_line(-nx, -ny, reach);
    }
  } else if (p.kind == Kind::cylinder || p.kind == Kind::cone) {
    // Tangents all round, among them those along and across the axis, which are sides when it lies.
    const double flat = std::hypot(axis_.x, axis_.y);
    const double ax = flat > 1e-9 ? axis_.x / flat : 1, ay = flat > 1e-9 ? axis_.y / flat : 0;
    for (int k = 0; k < kTangents; ++k) {
      const auto [c, s] = directions()[static_cast<std::size_t>(k)];
      const double nx = c * ax - s * ay, ny = c * ay + s * ax, along = nx * axis_.x + ny * axis_.y;
      const double rim = p.radius * std::sqrt(std::max(0.0, 1 - along * along));
      const double base = p.half_length * (p.kind == Kind::cone ? -along : std::abs(along)) + rim;
      add_line(nx, ny, p.kind == Kind::cone ? std::max(base, p.half_length * along) : base);
    }
    // From the tip of a cone along its base.
    const double to_rim = p.radius / std::hypot(2 * p.half_length, p.radius);
    if (p.kind == Kind::cone && flat > to_rim)
      for (const double side : {-1.0, 1.0}) {
        const double c = to_rim / flat, s = side * std::sqrt(1 - c * c);
        add_line(c * ax - s * ay, c * ay + s * ax, p.half_length * flat * c);
      }
  } else if (p.kind == Kind::hull) {
    // Edges between a face seen from below and one that is not.
    const auto faces_down = [&](std::uint32_t f) { return dot(p.hull->faces[f].normal, up_) < 0; };
    for (const ConvexHull::Edge& edge : p.hull->edges) {
      if (faces_down(edge.left) == faces_down(edge.right)) continue;
      const Vec3d a = math::operator*(axes_, p.hull->corners[edge.a]),
                  b = math::operator*(axes_, p.hull->corners[edge.b]);
      const double dx = b.x - a.x, dy = b.y - a.y, size = std::hypot(dx, dy);
      if (size < 1e-12) continue;
      double nx = dy / size, ny = -dx / size;
      const Vec3d left = math::operator*(axes_, p.hull->faces[edge.left].normal),
                  right = math::operator*(axes_, p.hull->faces[edge.right].normal);
      if (nx * (left.x + right.x) + ny * (left.y + right.y) < 0) nx = -nx, ny = -ny;
      add_line(nx, ny, nx * a.x + ny * a.y);
    }
  }
}

double PosedPiece::outside(double x, double y, Vec3d& away) const {
  if (outline_.empty()) {
    // A ball, or the nearest ball of a capsule.
    const double dx = x - position_.x, dy = y - position_.y, flat = axis_.x * axis_.x + axis_.y * axis_.y;
    const double half = piece_->kind == Kind::capsule ? piece_->half_length : 0;
    const double along = flat > 1e-12 ? std::clamp((dx * axis_.x + dy * axis_.y) / flat, -half, half) : 0;
    const double px = dx - along * axis_.x, py = dy - along * axis_.y, distance = std::sqrt(px * px + py * py);
    away = distance > 0 ? Vec3d{px / distance, py / distance, 0} : Vec3d{1, 0, 0};
    return distance - piece_->radius;
  }
  double most = -kInf;
  for (const Line& line : outline_) {
    const double distance = line.x * x + line.y * y - line.offset;
    if (distance > most) most = distance, away = {line.x, line.y, 0};
  }
  return most;
}

Cover PosedPiece::covered(double x, double y, double width) const {
  const double half = 0.5 * width;
  // The square, cut by each line that crosses it.
  std::array<Vec3d, 4 + 2 * kTangents> corners, kept;
  std::size_t count = 4;
  corners[0] = {-half, -half, 0}, corners[1] = {half, -half, 0}, corners[2] = {half, half, 0},
  corners[3] = {-half, half, 0};
  const auto cut = [&](double nx, double ny, double room) {
    if (room >= half * (std::abs(nx) + std::abs(ny)) || count + 2 > corners.size()) return;
    std::size_t n = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const Vec3d &a = corners[k], &b = corners[(k + 1) % count];
      const double da = nx * a.x + ny * a.y - room, db = nx * b.x + ny * b.y - room;
      if (da <= 0) kept[n++] = a;
      if ((da <= 0) != (db <= 0)) kept[n++] = a + (da / (da - db)) * (b - a);
    }
    std::copy_n(kept.begin(), n, corners.begin());
    count = n;
  };
  if (outline_.empty()) {
    Vec3d away;
    const double distance = outside(x, y, away);
    cut(away.x, away.y, -distance);
  } else {
    for (const Line& line : outline_) cut(line.x, line.y, line.offset - line.x * x - line.y * y);
  }
  Cover cover;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3d &a = corners[k], &b = corners[(k + 1) % count];
    const double twice = a.x * b.y - b.x * a.y;
    cover.area += 0.5 * twice;
    cover.x += twice * (a.x + b.x) / 6, cover.y += twice * (a.y + b.y) / 6;
  }
  if (!(cover.area > 1e-9 * width * width)) return {};
  return {cover.area, x + cover.x / cover.area, y + cover.y / cover.area};
}

// ---- points of first touch

std::optional<Ridge> PosedPiece::ridge(const Vec3d& up) const {
  const Piece& p = *piece_;
  if (p.kind == Kind::sphere) return Ridge{position_ - p.radius * up, position_ - p.radius * up};
  if (p.kind != Kind::cylinder && p.kind != Kind::capsule && p.kind != Kind::cone) return std::nullopt;
  const Vec3d across = up - dot(up, axis_) * axis_;
  const double size = length(across);
  constexpr double kStands = 0.05;  // a cylinder that stands on its end touches with the end
  if (size < kStands) return std::nullopt;
  const Vec3d out = across * (-p.radius / size), half = p.half_length * axis_;
  if (p.kind == Kind::cone) return Ridge{position_ - half + out, position_ + half};
  return Ridge{position_ - half + out, position_ + half + out};
}

Vec3d PosedPiece::lowest() const {
  const Piece& p = *piece_;
  if (p.kind == Kind::sphere) return position_ - Vec3d{0, 0, p.radius};
  // Corners weighted by how low they lie, on a scale of some percent of the piece's height.
  const double scale = 0.02 * std::max(high.z - low.z, 1e-9);
  Vec3d sum;
  double weights = 0;
  const auto add = [&](const Vec3d& corner) {
    const double weight = std::exp(-(corner.z - low.z) / scale);
    sum += weight * corner, weights += weight;
  };
  if (p.kind == Kind::box) {
    for (int k = 0; k < 8; ++k)
      add(position_ + math::operator*
          (axes_, Vec3d{k & 1 ? p.half.x : -p.half.x, k & 2 ? p.half.y : -p.half.y, k & 4 ? p.half.z : -p.half.z}));
  } else if (p.kind == Kind::hull) {
    for (const Vec3d& corner : p.hull->corners) add(position_ + math::operator*(axes_, corner));
  } else {
    const Vec3d u = math::column(axes_, 0), v = math::column(axes_, p.kind == Kind::cone ? 1 : 2);
    for (const double side : {-1.0, 1.0}) {
      const Vec3d end = position_ + (side * p.half_length) * axis_;
      if (p.kind == Kind::capsule) add(end - Vec3d{0, 0, p.radius});
      if (p.kind == Kind::cone && side > 0) add(end);
      if (p.kind == Kind::capsule || (p.kind == Kind::cone && side > 0)) continue;
      for (int k = 0; k < kTangents; ++k) {
        const double angle = 2 * std::numbers::pi * k / kTangents;
        add(end + p.radius * (std::cos(angle) * u + std::sin(angle) * v));
      }
    }
  }
  return sum * (1 / weights);
}

// ---- the whole

void PosedSolid::place(const Solid& solid, const Vec3d& position, const Quat& orientation, bool outlined) {
  pieces_.resize(solid.pieces.size());
  position_ = position, radius_ = solid.radius;
  ball_ = solid.pieces.size() == 1 && solid.pieces[0].kind == Kind::sphere;
  low_ = {kInf, kInf, kInf}, high_ = {-kInf, -kInf, -kInf};
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const Piece& piece = solid.pieces[k];
    PosedPiece& p = pieces_[k];
    p.place(piece, position + math::rotate(orientation, piece.position),
            math::matrix_of(math::operator*(orientation, piece.rotation)), outlined);
    low_ = {std::min(low_.x, p.low.x), std::min(low_.y, p.low.y), std::min(low_.z, p.low.z)};
    high_ = {std::max(high_.x, p.high.x), std::max(high_.y, p.high.y), std::max(high_.z, p.high.z)};
  }
}

Underside PosedSolid::underside(double x, double y) const {
  Underside lowest;
  for (const PosedPiece& piece : pieces_) {
    const Underside under = piece.underside(x, y);
    if (under.below && (!lowest.below || under.height < lowest.height)) lowest = under;
  }
  return lowest;
}

bool PosedSolid::within_reach(const Vec3& p, double reach) const {
  if (!ball_) return over(p.x, p.y, reach) && p.z >= low_.z - reach;
  const double dx = p.x - position_.x, dy = p.y - position_.y, wide = radius_ + reach;
  const double side = wide * wide - dx * dx - dy * dy;
  return side >= 0 && p.z >= position_.z - std::sqrt(side);
}

double sweep_speed(const Solid& solid, const Quat& orientation, const Vec3d& w) {
  if (solid.pieces.size() != 1) return solid.radius * length(w);
  const Piece& piece = solid.pieces[0];
  if (piece.kind == Kind::sphere) return 0;
  if (piece.kind == Kind::box || piece.kind == Kind::hull) return solid.radius * length(w);
  const Vec3d axis = math::rotate(math::operator*(orientation, piece.rotation),
                                  piece.kind == Kind::cone ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0});
  return solid.radius * length(cross(w, axis));
}

}  // namespace divot::geometry
