#include "geometry/solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace divot::geometry {
namespace {

using math::Matrix3;

Matrix3 diagonal(double x, double y, double z) { return {Vec3d{x, 0, 0}, Vec3d{0, y, 0}, Vec3d{0, 0, z}}; }
Matrix3 operator+(const Matrix3& a, const Matrix3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Matrix3 operator*(const Matrix3& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }

// Inertia of a kilogram at `r`.
Matrix3 point_inertia(const Vec3d& r) {
  const double rr = dot(r, r);
  return {Vec3d{rr - r.x * r.x, -r.x * r.y, -r.x * r.z}, Vec3d{-r.y * r.x, rr - r.y * r.y, -r.y * r.z},
          Vec3d{-r.z * r.x, -r.z * r.y, rr - r.z * r.z}};
}

// R I R^T.
Matrix3 rotated(const Matrix3& inertia, const Quat& q) {
  const Matrix3 r = math::matrix_of(q);
  Matrix3 half, whole;
  for (int i = 0; i < 3; ++i) half[i] = inertia[0] * r[i].x + inertia[1] * r[i].y + inertia[2] * r[i].z;
  for (int i = 0; i < 3; ++i) whole[i] = {dot(half[i], r[0]), dot(half[i], r[1]), dot(half[i], r[2])};
  return whole;
}

MassProperties of(const Sphere& s) {
  const double i = 0.4 * s.radius * s.radius;
  return {4.0 / 3 * std::numbers::pi * s.radius * s.radius * s.radius, {}, diagonal(i, i, i)};
}

MassProperties of(const Box& b) {
  const double x = b.size.x * b.size.x, y = b.size.y * b.size.y, z = b.size.z * b.size.z;
  return {b.size.x * b.size.y * b.size.z, {}, diagonal((y + z) / 12, (x + z) / 12, (x + y) / 12)};
}

MassProperties of(const Cylinder& c) {
  const double rr = c.radius * c.radius, across = rr / 4 + c.length * c.length / 12;
  return {std::numbers::pi * rr * c.length, {}, diagonal(across, rr / 2, across)};
}

MassProperties of(const Capsule& c) {
  const double r = c.radius, h = c.length, tube = std::numbers::pi * r * r * h,
               ball = 4.0 / 3 * std::numbers::pi * r * r * r, whole = tube + ball;
  const double along = (tube * r * r / 2 + ball * 0.4 * r * r) / whole;
  // Each half ball's centre of mass lies 3/8 r beyond its flat side.
  const double across = (tube * (r * r / 4 + h * h / 12) + ball * (0.4 * r * r + h * h / 4 + 3.0 / 8 * h * r)) / whole;
  return {whole, {}, diagonal(across, along, across)};
}

MassProperties of(const Cone& c) {
  const double rr = c.radius * c.radius, hh = c.height * c.height, across = 3.0 / 20 * rr + 3.0 / 80 * hh;
  return {std::numbers::pi * rr * c.height / 3, {0, 0, -c.height / 4}, diagonal(across, across, 0.3 * rr)};
}

// Sums over tetrahedra between a corner and the triangles.
MassProperties of(const ConvexHull& hull) {
  const Vec3d base = hull.corners[0];
  double volume = 0;
  Vec3d first;          // integral of r
  Matrix3 second = {};  // integral of r r^T
  for (std::size_t t = 0; t < hull.triangles.size(); t += 3) {
    const std::array<Vec3d, 3> p = {hull.corners[hull.triangles[t]] - base, hull.corners[hull.triangles[t + 1]] - base,
                                    hull.corners[hull.triangles[t + 2]] - base};
    const double v = dot(p[0], cross(p[1], p[2])) / 6;
    const Vec3d sum = p[0] + p[1] + p[2];
    volume += v;
    first += (v / 4) * sum;
    for (const Vec3d& q : {p[0], p[1], p[2], sum}) second = second + Matrix3{q * q.x, q * q.y, q * q.z} * (v / 20);
  }
  const Vec3d center = first * (1 / volume);
  const Matrix3 spread = second * (1 / volume);
  const double trace = spread[0].x + spread[1].y + spread[2].z;
  const Matrix3 about_base = diagonal(trace, trace, trace) + spread * -1;
  return {volume, base + center, about_base + point_inertia(center) * -1};
}

std::optional<ConvexHull> hull_of(const Hull& hull) {
  std::vector<Vec3d> points = hull.points;
  for (Vec3d& p : points) p *= hull.scale;
  return convex_hull(points);
}

std::optional<MassProperties> of(const ConvexShape& shape) {
  return std::visit(
      [](const auto& s) -> std::optional<MassProperties> {
        if constexpr (std::is_same_v<std::decay_t<decltype(s)>, Hull>) {
          const auto hull = hull_of(s);
          return hull ? std::optional(of(*hull)) : std::nullopt;
        } else {
          return of(s);
        }
      },
      shape);
}

std::vector<Part> parts_of(const Shape& shape) {
  if (const auto* compound = std::get_if<Compound>(&shape)) return compound->parts;
  return {std::visit(
      [](const auto& s) -> Part {
        if constexpr (std::is_same_v<std::decay_t<decltype(s)>, Compound>)
          return {};
        else
          return {.shape = s};
      },
      shape)};
}

std::optional<Piece> piece_of(const ConvexShape& shape) {
  Piece piece;
  using Kind = Piece::Kind;
  if (const auto* s = std::get_if<Sphere>(&shape)) piece.kind = Kind::sphere, piece.radius = s->radius;
  if (const auto* b = std::get_if<Box>(&shape)) piece.kind = Kind::box, piece.half = 0.5 * b->size;
  if (const auto* c = std::get_if<Cylinder>(&shape))
    piece.kind = Kind::cylinder, piece.radius = c->radius, piece.half_length = 0.5 * c->length;
  if (const auto* c = std::get_if<Capsule>(&shape))
    piece.kind = Kind::capsule, piece.radius = c->radius, piece.half_length = 0.5 * c->length;
  if (const auto* c = std::get_if<Cone>(&shape))
    piece.kind = Kind::cone, piece.radius = c->radius, piece.half_length = 0.5 * c->height;
  if (const auto* h = std::get_if<Hull>(&shape)) {
    auto hull = hull_of(*h);
    if (!hull) return std::nullopt;
    piece.kind = Kind::hull, piece.hull = std::make_shared<const ConvexHull>(std::move(*hull));
  }
  return piece;
}

// Farthest that a piece reaches from a point given in its own axes, m.
double reach_from(const Piece& piece, const Vec3d& p) {
  switch (piece.kind) {
    case Piece::Kind::sphere:
      return length(p) + piece.radius;
    case Piece::Kind::box:
      return length(Vec3d{std::abs(p.x) + piece.half.x, std::abs(p.y) + piece.half.y, std::abs(p.z) + piece.half.z});
    case Piece::Kind::cylinder:
      return std::hypot(std::hypot(p.x, p.z) + piece.radius, std::abs(p.y) + piece.half_length);
    case Piece::Kind::capsule:
      return std::hypot(p.x, std::abs(p.y) + piece.half_length, p.z) + piece.radius;
    case Piece::Kind::cone:
      return std::max(std::hypot(std::hypot(p.x, p.y) + piece.radius, p.z + piece.half_length),
                      length(p - Vec3d{0, 0, piece.half_length}));
    case Piece::Kind::hull:
      break;
  }
  double most = 0;
  for (const Vec3d& corner : piece.hull->corners) most = std::max(most, length(corner - p));
  return most;
}

// Principal axes of a symmetric matrix by Jacobi's rotations: columns of a right-handed rotation, with the moments.
struct Principal {
  Quat axes;
  Vec3d moments;
};
Principal principal(const Matrix3& inertia) {
  double a[3][3] = {{inertia[0].x, inertia[0].y, inertia[0].z},
                    {inertia[1].x, inertia[1].y, inertia[1].z},
                    {inertia[2].x, inertia[2].y, inertia[2].z}};
  double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double scale = std::max({a[0][0], a[1][1], a[2][2]});
  for (int sweep = 0; sweep < 30; ++sweep)
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        // Products of inertia that are rounding only must not turn the axes of a symmetric body.
        if (std::abs(a[p][q]) <= 1e-12 * scale) continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (auto& row : a) {
          const double x = row[p], y = row[q];
          row[p] = c * x - s * y, row[q] = s * x + c * y;
        }
        for (int k = 0; k < 3; ++k) {
          const double x = a[p][k], y = a[q][k];
          a[p][k] = c * x - s * y, a[q][k] = s * x + c * y;
        }
        for (auto& row : v) {
          const double x = row[p], y = row[q];
          row[p] = c * x - s * y, row[q] = s * x + c * y;
        }
      }
  const Vec3d x{v[0][0], v[1][0], v[2][0]}, y{v[0][1], v[1][1], v[2][1]};
  return {math::from_columns(x, y, cross(x, y)), {a[0][0], a[1][1], a[2][2]}};
}

}  // namespace

std::optional<MassProperties> mass_properties(const Shape& shape) {
  MassProperties sum;
  std::vector<MassProperties> placed;
  for (const Part& part : parts_of(shape)) {
    auto one = of(part.shape);
    if (!one) return std::nullopt;
    const Quat q = rotation(part.rotation_deg);
    placed.push_back({one->volume, part.position + math::rotate(q, one->center), rotated(one->inertia, q)});
    sum.volume += one->volume;
    sum.center += one->volume * placed.back().center;
  }
  if (!(sum.volume > 0)) return std::nullopt;
  sum.center *= 1 / sum.volume;
  sum.inertia = {};
  for (const MassProperties& one : placed)
    sum.inertia = sum.inertia + (one.inertia + point_inertia(one.center - sum.center)) * (one.volume / sum.volume);
  return sum;
}

std::optional<Solid> make_solid(const Shape& shape, const std::optional<Vec3d>& center,
                                const std::optional<Vec3d>& inertia) {
  const auto filled = mass_properties(shape);
  if (!filled) return std::nullopt;
  const Vec3d middle = center.value_or(filled->center);
  // About another centre the same filling has another inertia.
  Matrix3 about = filled->inertia + point_inertia(middle - filled->center);
  if (inertia) about = diagonal(inertia->x, inertia->y, inertia->z);
  const Principal p = principal(about);

  Solid solid{.radius = 0, .axes = math::conjugate(p.axes), .inertia = p.moments};
  solid.origin = math::rotate(solid.axes, -middle);
  for (const Part& part : parts_of(shape)) {
    auto piece = piece_of(part.shape);
    if (!piece) return std::nullopt;
    piece->position = math::rotate(solid.axes, part.position - middle);
    piece->rotation = math::operator*(solid.axes, rotation(part.rotation_deg));
    const Vec3d center_there = math::rotate(math::conjugate(piece->rotation), -piece->position);
    solid.radius = std::max(solid.radius, reach_from(*piece, center_there));
    solid.pieces.push_back(std::move(*piece));
  }
  return solid;
}

Shape drawn(const Shape& shape) {
  const auto reduce = [](Hull& hull) {
    auto reduced = hull_of(hull);
    if (!reduced) return;
    hull.points = std::move(reduced->corners), hull.triangles = std::move(reduced->triangles), hull.scale = 1;
  };
  Shape out = shape;
  if (auto* hull = std::get_if<Hull>(&out)) reduce(*hull);
  if (auto* compound = std::get_if<Compound>(&out))
    for (Part& part : compound->parts)
      if (auto* hull = std::get_if<Hull>(&part.shape)) reduce(*hull);
  return out;
}

}  // namespace divot::geometry

namespace divot {

Quat rotation(const Vec3d& rotation_deg) {
  const auto about = [](double degrees, int axis) {
    const double half = 0.5 * degrees * std::numbers::pi / 180, s = std::sin(half);
    return Quat{axis == 0 ? s : 0, axis == 1 ? s : 0, axis == 2 ? s : 0, std::cos(half)};
  };
  using math::operator*;
  return about(rotation_deg.z, 2) * about(rotation_deg.y, 1) * about(rotation_deg.x, 0);
}

}  // namespace divot
