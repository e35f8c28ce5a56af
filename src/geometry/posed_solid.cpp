#include "geometry/posed_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace divot::geometry {
namespace {

using Kind = Piece::Kind;
using math::Matrix3;

constexpr double kInf = std::numeric_limits<double>::infinity();
// Points all round a rim, of which the lowest count.
constexpr int kRimPoints = 48;

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
      for (int k = 0; k < kRimPoints; ++k) {
        const double angle = 2 * std::numbers::pi * k / kRimPoints;
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
