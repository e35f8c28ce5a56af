#include "contact/rim_shear.h"

#include <algorithm>
#include <cmath>

namespace divot::contact {
namespace {

// Speed of the body's surface over a column, m/s, that its spin alone makes: of the rim.
Vec3d rim_speed_at(const Contact& c, const Row& v) {
  const Vec3d turning = cross(math::angular(v), c.arm);
  return dot(turning, c.tangent[0]) * c.tangent[0] + dot(turning, c.tangent[1]) * c.tangent[1];
}

// Slip along the rim's speed, and across it.
struct Slip {
  double along = 0, across = 0;  // m/s
};
Slip slip_at(const Contact& c, const Row& v, const Vec3d& rim_speed) {
  const Vec3d slip = dot6(c.slip[0], v) * c.tangent[0] + dot6(c.slip[1], v) * c.tangent[1];
  const Vec3d along = rim_speed * (1 / length(rim_speed)), across = slip - dot(slip, along) * along;
  return {dot(slip, along), length(across)};
}

}  // namespace

void limit_to_rim(std::span<const Contact> contacts, const Row& v, double dt, std::span<Footing> footings) {
  const auto pressed = [&](const Contact& c) { return c.underside < footings[c.footing].height; };
  Vec3d sum;
  double speeds = 0;
  for (const Contact& c : contacts) {
    if (!pressed(c)) continue;
    const Vec3d speed = rim_speed_at(c, v);
    sum += speed, speeds += length(speed);
  }
  // What spins on the spot has no front.
  const double common = length(sum);
  if (common <= 0.5 * speeds || speeds <= 0) return;
  const Vec3d to_front = sum * (-1 / common);
  const Contact* front = nullptr;
  for (const Contact& c : contacts)
    if (pressed(c) && (front == nullptr || dot(c.arm, to_front) > dot(front->arm, to_front))) front = &c;
  const double beyond = 0.5 * std::sqrt(footings[front->footing].area);
  const Vec3d speed_at_front = rim_speed_at(*front, v);
  if (length(speed_at_front) <= 0) return;
  const double slip_at_front = slip_at(*front, v, speed_at_front).along;
  for (const Contact& c : contacts) {
    Footing& f = footings[c.footing];
    const Vec3d speed = rim_speed_at(c, v);
    const double remembered = length(f.shear);
    if (!pressed(c) || remembered <= 0 || length(speed) <= 0) continue;
    const double level = dot(front->arm - c.arm, to_front), down = front->arm.z - c.arm.z;
    // This step's own shear comes to what is remembered.
    const double since = std::max(0.0, (std::hypot(level, down) + beyond) / length(speed) - dt);
    const Slip slip = slip_at(c, v, speed);
    const double most = std::hypot(0.5 * (slip_at_front + slip.along), slip.across) * since;
    if (remembered > most) f.shear = (most / remembered) * f.shear;
  }
}

}  // namespace divot::contact
