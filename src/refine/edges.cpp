#include "refine/edges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/posed_solid.h"

namespace divot::refine {
namespace {

using geometry::Piece;
using geometry::PosedPiece;

// Least number of edges across what is pressed.
constexpr double kAcross = 4;

// Under a ball at rest, with pressures that rise from its rim to its middle; that of a patch as wide as its radius.
double ball_sinkage(double radius, double load, const laws::Medium& m) {
  const double n = m.bekker_n, k = m.bekker_kphi + m.bekker_kc / radius;
  return std::pow((n + 1) * load / (2 * std::numbers::pi * k * radius), 1 / (n + 1));
}

// Under a wheel that rolls. [Bekker 1969]
double wheel_sinkage(double radius, double width, double load, const laws::Medium& m) {
  const double n = m.bekker_n, resists = std::max(0.1, 3 - n) * (m.bekker_kc + width * m.bekker_kphi);
  return std::pow(3 * load / (resists * std::sqrt(2 * radius)), 2 / (2 * n + 1));
}

// The smaller side of the face that looks down most, m: of the box around a piece in its own axes.
double width_of(const Piece& piece, const math::Matrix3& axes) {
  PosedPiece own;
  own.place(piece, {}, math::matrix_of(Quat{}), false);
  const Vec3d size = own.high - own.low;
  const double up[3] = {std::abs(axes[2].x), std::abs(axes[2].y), std::abs(axes[2].z)};
  if (up[2] >= std::max(up[0], up[1])) return std::min(size.x, size.y);
  return up[1] >= up[0] ? std::min(size.x, size.z) : std::min(size.y, size.z);
}

double piece_edge(const Piece& piece, const math::Matrix3& axes, double load, const laws::Medium& medium,
                  const Accuracy& accuracy) {
  PosedPiece posed;
  posed.place(piece, {}, axes, false);
  const auto ridge = posed.ridge({0, 0, 1});
  if (!ridge) return width_of(piece, axes) / kAcross;
  const bool is_ball = piece.kind == Piece::Kind::sphere,
             has_round_ends = is_ball || piece.kind == Piece::Kind::capsule;
  const double radius = piece.radius, width = length(ridge->to - ridge->from) + (has_round_ends ? radius : 0);
  double sinkage = 0;
  if (medium.ground)
    sinkage = is_ball ? ball_sinkage(radius, load, medium) : wheel_sinkage(radius, width, load, medium);
  const double gap = std::max(accuracy.tolerance, accuracy.error * std::min(sinkage, radius));
  return std::min(std::sqrt(8 * radius * gap), width / kAcross);
}

}  // namespace

double contact_edge(const geometry::Solid& solid, const Quat& orientation, double load, const laws::Medium& medium,
                    const Accuracy& accuracy) {
  const double share = load / static_cast<double>(solid.pieces.size());
  double least = std::numeric_limits<double>::infinity();
  for (const Piece& piece : solid.pieces) {
    using math::operator*;
    const math::Matrix3 axes = math::matrix_of(orientation * piece.rotation);
    least = std::min(least, piece_edge(piece, axes, share, medium, accuracy));
  }
  return least;
}

double crater_edge(double radius, double depth, double turn) {
  // A bowl of z = depth (r / radius)^2 turns by 2 depth / radius^2 a metre.
  return turn * radius * radius / (2 * depth);
}

}  // namespace divot::refine
