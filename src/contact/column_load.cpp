#include "contact/column_load.h"

#include <algorithm>
#include <cmath>

#include "contact/near.h"

namespace divot::contact {
namespace {

// Flanks steeper than this push sideways no harder: at the equator of a ball the vertical columns would push
// infinitely.
constexpr double kSteepestFlank = 0.25;  // |vertical part of the normal|

// Speed along `direction` of the point of the body at `arm`.
Row row_of(const Vec3d& direction, const Vec3d& arm) {
  const Vec3d turn = cross(arm, direction);
  return {direction.x, direction.y, direction.z, turn.x, turn.y, turn.z};
}

double patch(const state::Body& body) { return std::max(body.patch_width, 0.5 * body.spacing); }

double underside_at(const Contact& c, double rising, double dt) { return c.underside + dt * (rising - c.rise_there); }

// Of soil that the column's underside presses at `speed`, m/s.
laws::Pressure<double> pressure_of(const state::Body& body, const Footing& f, double sinkage, double speed,
                                   const Situation& s) {
  const laws::Medium& medium = s.media[f.material];
  return laws::ground_pressure<double>(medium, sinkage, f.plastic, patch(body), medium.elastic_stiffness, speed);
}

// A sheet of particles without ground: their own inertia, and their bonds. A particle that a body carries already moves
// with it; others are met at their own speed.
Push push_of_sheet(const state::Body& body, const Footing& f, const Contact& c, double rising, const Situation& s) {
  const Row now = math::row(body.velocity, body.angular_velocity);
  const double inertia = f.mass / s.dt, met = f.carried ? dot6(c.rise, now) : f.speed;
  const Push push{f.pull + inertia * (met - rising), inertia};
  return push.force > 0 ? push : Push{};  // it does not pull
}

Contact frozen(const Footing& f, const geometry::Underside& under, const Vec3d& position, const Vec3d& ground,
               const Row& v) {
  Contact c{.underside = under.height};
  c.arm = {f.arm_x - position.x, f.arm_y - position.y, under.height - position.z};
  const double steep = std::max(kSteepestFlank, -under.normal.z);
  const Vec3d push{-under.normal.x / steep, -under.normal.y / steep, 1};
  c.slope = length(push);
  c.rise = row_of(push, c.arm);
  c.rise_there = dot6(c.rise, v);
  c.lift = {ground.x, ground.y, ground.z, c.rise[3], c.rise[4], c.rise[5]};

  // Slip is against soil that goes down with the body, but stays where it is while the body only moves along. Were it
  // to follow the underside of a wheel that rolls by, that would grip while it turns too fast, and never skid.
  const Vec3d level = cross(under.normal, Vec3d{0, 1, 0});
  const double l = length(level);
  c.tangent[0] = l > 1e-6 ? level * (1 / l) : Vec3d{1, 0, 0};
  c.tangent[1] = cross(under.normal, c.tangent[0]);
  for (int i = 0; i < 2; ++i) {
    c.slip[i] = row_of(c.tangent[i], c.arm);
    for (int k = 0; k < 6; ++k) c.slip[i][k] -= c.tangent[i].z * c.lift[k];
  }
  return c;
}

}  // namespace

void freeze_geometry(const state::Body& body, const Scratch::Pose& start, const Row& v, const Situation& s,
                     Scratch::PerBody& scratch) {
  scratch.contacts.clear();
  const Vec3d position = start.position + s.dt * Vec3d{v[0], v[1], v[2]};
  scratch.end.place(*body.solid, position, math::spun(start.orientation, {v[3], v[4], v[5]}, s.dt));
  for (std::uint32_t k = 0; k < scratch.footings.size(); ++k) {
    const Footing& f = scratch.footings[k];
    const geometry::Underside under = scratch.end.underside(f.x, f.y);
    if (!under.below) continue;
    scratch.contacts.push_back(frozen(f, under, position, scratch.ground, v));
    scratch.contacts.back().footing = k;
  }
}

Push push_of(const state::Body& body, const Footing& f, const Contact& c, const Row& v, const Situation& s) {
  const double rising = dot6(c.rise, v), height = underside_at(c, rising, s.dt);
  if (height >= f.height) return {};
  const laws::Medium& medium = s.media[f.material];
  if (!medium.ground) return push_of_sheet(body, f, c, rising, s);
  // Bekker's pressure, as it was measured, has in it what holds soil together at the patch's edge: bonds do not count.
  // A load that only moves along, slower than waves, radiates none.
  const double lifting = dot6(c.lift, v);
  const auto pressure = pressure_of(body, f, f.fresh - height, std::min(-rising, -lifting), s);
  // Only what yields is thrown out of the way.
  const auto throwing =
      pressure.yields ? laws::throwing_pressure<double>(medium, -rising / c.slope) : laws::Pressure<double>{};
  Push push{(pressure.value + throwing.value) * f.area, (pressure.slope * s.dt + throwing.damping / c.slope) * f.area};
  (rising > lifting ? push.per_rising : push.per_lifting) += pressure.damping * f.area;
  return push;
}

Shear shear_of(const laws::Medium& medium, const Footing& f, const Contact& c, const std::array<double, 2>& slip,
               double dt) {
  const double j[2] = {dot(f.shear, c.tangent[0]) + dt * slip[0], dot(f.shear, c.tangent[1]) + dt * slip[1]};
  const double size = std::sqrt(j[0] * j[0] + j[1] * j[1]), most = laws::kSlideShear * medium.shear_modulus;
  Shear shear;
  if (size <= 0) {
    shear.tangent = shear.secant = c.grip / medium.shear_modulus;
    return shear;
  }
  // Force by Janosi-Hanamoto; beyond the displacement at which the soil slides it stays the same.
  const double share = laws::mobilised_shear<double>(medium, std::min(size, most));
  for (int i = 0; i < 2; ++i) {
    shear.along[i] = j[i] / size;
    shear.force[i] = c.grip * share * shear.along[i];
  }
  shear.secant = c.grip * share / size;
  shear.tangent = size < most ? c.grip * (1 - share) / medium.shear_modulus : 0;
  return shear;
}

double grip_of(const state::Body& body, const Footing& f, const Contact& c, const Situation& s) {
  if (f.load <= 0) return 0;
  const double contact_area = f.area * c.slope, normal_force = f.load * c.slope;
  return std::min(laws::shear_strength<double>(s.media[f.material], normal_force / contact_area) * contact_area,
                  body.friction * normal_force);
}

Answer answer_of(const state::Body& body, const Footing& f, const Contact& c, const Row& v, const Situation& s) {
  const laws::Medium& medium = s.media[f.material];
  const double sinkage = f.fresh - underside_at(c, dot6(c.rise, v), s.dt);
  const auto pressure = medium.ground ? pressure_of(body, f, sinkage, 0, s) : laws::Pressure<double>{};
  Answer answer{.plastic = f.plastic, .pressure = pressure.value};
  if (pressure.yields) answer.plastic = std::max(f.plastic, sinkage - pressure.value / medium.elastic_stiffness);

  // Beyond the displacement at which the soil slides the rest is slip.
  Vec3d shear;
  for (int i = 0; i < 2; ++i) shear += (dot(f.shear, c.tangent[i]) + s.dt * dot6(c.slip[i], v)) * c.tangent[i];
  const double size = length(shear), most = laws::kSlideShear * medium.shear_modulus;
  answer.shear = f.load <= 0 ? Vec3d{} : size > most ? shear * (most / size) : shear;
  return answer;
}

}  // namespace divot::contact
