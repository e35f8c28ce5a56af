// Outlines: what a piece covers, seen from below.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/posed_solid.h"

namespace divot::geometry {
namespace {

using Kind = Piece::Kind;

constexpr double kInf = std::numeric_limits<double>::infinity();
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
}  // namespace

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
      const double half[3] = {p.half.x, p.half.y, p.half.z};
      double reach = 0;
      for (int k = 0; k < 3; ++k) {
        const Vec3d other = math::column(axes_, k);
        reach += std::abs(nx * other.x + ny * other.y) * half[k];
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

}  // namespace divot::geometry
