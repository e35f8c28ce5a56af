#include "contact/rim_shear.h"

#include <algorithm>
#include <cmath>

namespace divot::contact {
namespace {

// A column as the rim sees it.
struct Place {
  Vec3d arm, tangent, other;
  Vec3d rim_speed;  // m/s, of the body's surface there, that its spin alone makes

  Place(const Columns& columns, std::size_t k, const Row& v)
      : arm(columns.at(&ColumnBlock::arm, k)), other(columns.at(&ColumnBlock::other, k)) {
    const ColumnBlock& b = columns.blocks[k / ColumnBlock::kColumns];
    tangent = {b.tangent[0][k % ColumnBlock::kColumns], 0, b.tangent[1][k % ColumnBlock::kColumns]};
    const Vec3d turning = cross(math::angular(v), arm);
    rim_speed = dot(turning, tangent) * tangent + dot(turning, other) * other;
  }
};

// Slip along the rim's speed, and across it.
struct RimSlip {
  double along = 0, across = 0;  // m/s
};
RimSlip slip_at(const Columns& columns, std::size_t k, const Place& place, const Row& v) {
  const ColumnBlock& b = columns.blocks[k / ColumnBlock::kColumns];
  const auto speed = [&](const ColumnBlock::Four(&row)[5]) {
    const std::size_t i = k % ColumnBlock::kColumns;
    return row[0][i] * v[0] + row[1][i] * v[1] + (row[2][i] * v[3] + row[3][i] * v[4] + row[4][i] * v[5]);
  };
  const Vec3d slip = speed(b.slip) * place.tangent + speed(b.other_slip) * place.other;
  const Vec3d along = place.rim_speed * (1 / length(place.rim_speed)), across = slip - dot(slip, along) * along;
  return {dot(slip, along), length(across)};
}

}  // namespace

void limit_to_rim(const Row& v, double dt, std::span<Footing> footings, Columns& columns) {
  const auto pressed = [&](std::size_t k) { return columns.at(&ColumnBlock::underside, k) < footings[k].height; };
  Vec3d sum;
  double speeds = 0;
  for (std::size_t k = 0; k < footings.size(); ++k) {
    if (!pressed(k)) continue;
    const Vec3d speed = Place(columns, k, v).rim_speed;
    sum += speed, speeds += length(speed);
  }
  // What spins on the spot has no front.
  const double common = length(sum);
  if (common <= 0.5 * speeds || speeds <= 0) return;
  const Vec3d to_front = sum * (-1 / common);
  std::size_t front = footings.size();
  double furthest = 0;
  for (std::size_t k = 0; k < footings.size(); ++k) {
    if (!pressed(k)) continue;
    const double ahead = dot(columns.at(&ColumnBlock::arm, k), to_front);
    if (front == footings.size() || ahead > furthest) front = k, furthest = ahead;
  }
  const double beyond = 0.5 * std::sqrt(footings[front].area);
  const Place at_front(columns, front, v);
  if (length(at_front.rim_speed) <= 0) return;
  const double slip_at_front = slip_at(columns, front, at_front, v).along;
  for (std::size_t k = 0; k < footings.size(); ++k) {
    const double remembered = length(footings[k].shear);
    if (remembered <= 0 || !pressed(k)) continue;
    const Place place(columns, k, v);
    const double speed = length(place.rim_speed);
    if (speed <= 0) continue;
    const double level = dot(at_front.arm - place.arm, to_front), down = at_front.arm.z - place.arm.z;
    // This step's own shear comes to what is remembered.
    const double since = std::max(0.0, (std::sqrt(level * level + down * down) + beyond) / speed - dt);
    const RimSlip slip = slip_at(columns, k, place, v);
    const double mean = 0.5 * (slip_at_front + slip.along);
    const double most = std::sqrt(mean * mean + slip.across * slip.across) * since;
    if (remembered <= most) continue;
    Vec3d& shear = footings[k].shear;
    shear = (most / remembered) * shear;
    ColumnBlock& b = columns.blocks[k / ColumnBlock::kColumns];
    const std::size_t i = k % ColumnBlock::kColumns;
    b.shear[0][i] = shear.x, b.shear[1][i] = shear.y, b.shear[2][i] = shear.z;
  }
}

}  // namespace divot::contact
