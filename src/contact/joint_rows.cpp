#include "contact/joint_rows.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace divot::contact {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
// Share of its position error that a joint takes back in a step.
constexpr double kCorrection = 0.2;
constexpr double kRadian = std::numbers::pi / 180;

// A joint's frame where its body is now, and how that moves.
struct Place {
  Vec3d anchor, center;
  Vec3d x, y, z;
  Vec3d velocity, spin;
};

Place place_of(const state::JointFrame& frame, std::uint32_t body, std::span<const state::Body> bodies) {
  const bool world = body == kNone;
  const Quat turned = world ? frame.axes : math::operator*(bodies[body].orientation, frame.axes);
  const math::Matrix3 axes = math::matrix_of(turned);
  Place p{.x = math::column(axes, 0), .y = math::column(axes, 1), .z = math::column(axes, 2)};
  if (world) {
    p.anchor = p.center = frame.anchor;
    return p;
  }
  const state::Body& b = bodies[body];
  p.center = b.position, p.velocity = b.velocity, p.spin = b.angular_velocity;
  p.anchor = b.position + math::rotate(b.orientation, frame.anchor);
  return p;
}

class Builder {
 public:
  Builder(state::HeldJoint& joint, const Place& first, const Place& second, double dt, std::vector<ConstraintRow>& rows)
      : joint_(joint), first_(first), second_(second), dt_(dt), rows_(rows), begin_(rows.size()) {}

  // Movement of the second anchor against the first body, along `line`.
  void travel(const Vec3d& line, double speed, double softness, double lower, double upper) {
    const Vec3d arm = second_.anchor - first_.center, own = second_.anchor - second_.center;
    add(math::row(-line, -cross(arm, line)), math::row(line, cross(own, line)), speed, softness, lower, upper);
  }
  void turn(const Vec3d& line, double speed, double softness, double lower, double upper) {
    add(math::row({}, -line), math::row({}, line), speed, softness, lower, upper);
  }
  void hold_travel(const Vec3d& line) {
    travel(line, -kCorrection / dt_ * dot(line, second_.anchor - first_.anchor), 0, -kInf, kInf);
  }
  void hold_turn(const Vec3d& line, double error) { turn(line, kCorrection / dt_ * error, 0, -kInf, kInf); }

  // Stops at the ends of travel. Both rows are always there, so that each keeps its impulse from step to step.
  template <class Add>
  void stops(double at, double scale, Add add_row) {
    const auto& s = joint_.settings;
    const auto speed_to = [&](double gap) { return (gap > 0 ? gap : kCorrection * gap) / dt_; };
    add_row(s.lower ? -speed_to(at - *s.lower * scale) : 0, 0, s.lower ? kInf : 0);
    add_row(s.upper ? speed_to(*s.upper * scale - at) : 0, s.upper ? -kInf : 0, 0);
  }

  std::size_t count() const { return rows_.size() - begin_; }

 private:
  void add(const math::Row& a, const math::Row& b, double speed, double softness, double lower, double upper) {
    ConstraintRow row{joint_.first, joint_.second, a, b, speed, softness, lower, upper, 0};
    row.impulse = std::min(std::max(joint_.impulse[count()], lower), upper);
    rows_.push_back(row);
  }

  state::HeldJoint& joint_;
  const Place &first_, &second_;
  double dt_;
  std::vector<ConstraintRow>& rows_;
  std::size_t begin_;
};

// The rotation vector that brings the second frame onto the first, for small errors.
Vec3d misalignment(const Place& first, const Place& second) {
  return 0.5 * (cross(second.x, first.x) + cross(second.y, first.y) + cross(second.z, first.z));
}

// Turn of the second frame about the first one's x, counted on from the last step.
double turned(const Place& first, const Place& second, double before) {
  const double angle = std::atan2(dot(second.y, first.z), dot(second.y, first.y));
  return before + std::remainder(angle - before, 2 * std::numbers::pi);
}

}  // namespace

void append_rows(state::HeldJoint& joint, std::span<const state::Body> bodies, double time, double dt,
                 std::vector<ConstraintRow>& rows) {
  const Joint& s = joint.settings;
  const Place first = place_of(joint.on_first, joint.first, bodies),
              second = place_of(joint.on_second, joint.second, bodies);
  const double at = time + dt, motor_speed = joint.motor ? joint.motor->first : s.motor_speed.at(at);
  const double motor_impulse = dt * (joint.motor ? joint.motor->second : s.motor_force.at(at));
  const Vec3d apart = second.anchor - first.anchor, spin = second.spin - first.spin;
  const Vec3d moving = second.velocity + cross(second.spin, second.anchor - second.center) - first.velocity -
                       cross(first.spin, second.anchor - first.center);
  Builder add(joint, first, second, dt, rows);

  // Motor first, so that keep_impulses() knows its row.
  if (s.type == JointType::hinge) {
    joint.turn = turned(first, second, joint.turn);
    joint.position = joint.turn, joint.speed = dot(spin, first.x);
    add.turn(first.x, motor_speed, 0, -motor_impulse, motor_impulse);
    add.stops(joint.turn, kRadian,
              [&](double speed, double lower, double upper) { add.turn(first.x, speed, 0, lower, upper); });
    for (const Vec3d& line : {first.x, first.y, first.z}) add.hold_travel(line);
    const Vec3d error = cross(second.x, first.x);
    add.hold_turn(first.y, dot(error, first.y)), add.hold_turn(first.z, dot(error, first.z));
    return;
  }
  if (s.type == JointType::fixed) {
    const Vec3d error = misalignment(first, second);
    for (const Vec3d& line : {first.x, first.y, first.z}) add.hold_travel(line), add.hold_turn(line, dot(error, line));
    return;
  }

  // Slider, spring and wheel travel along x.
  joint.position = dot(apart, first.x), joint.speed = dot(moving, first.x);
  if (s.type == JointType::wheel) {
    const double angle = kRadian * (joint.steering_deg ? *joint.steering_deg : s.steering_deg.at(at));
    const Vec3d axle = std::cos(angle) * first.y + std::sin(angle) * first.z, level = cross(first.x, axle);
    joint.speed = dot(spin, axle);
    add.turn(axle, motor_speed, 0, -motor_impulse, motor_impulse);
    const Vec3d error = cross(second.y, axle);
    add.hold_turn(first.x, dot(error, first.x)), add.hold_turn(level, dot(error, level));
  } else {
    add.travel(first.x, motor_speed, 0, -motor_impulse, motor_impulse);
    const Vec3d error = misalignment(first, second);
    for (const Vec3d& line : {first.x, first.y, first.z}) add.hold_turn(line, dot(error, line));
  }
  add.hold_travel(first.y), add.hold_travel(first.z);
  if (s.type != JointType::slider) {
    // Force at the end of the step: preload + k (x + dt x') + c x'.
    const double resistance = dt * s.stiffness + s.damping;
    add.travel(first.x, -(s.preload + s.stiffness * joint.position) / resistance, 1 / (dt * resistance), -kInf, kInf);
  }
  add.stops(joint.position, 1,
            [&](double speed, double lower, double upper) { add.travel(first.x, speed, 0, lower, upper); });
}

void find_guides(std::uint32_t body, std::span<const ConstraintRow> rows, std::span<const state::Body> bodies,
                 std::vector<Guide>& guides) {
  guides.clear();
  const auto along = [&](std::uint32_t other, const math::Row& line) {
    if (other == kNone) return 0.0;
    return math::dot6(line, math::row(bodies[other].velocity, bodies[other].angular_velocity));
  };
  for (const ConstraintRow& row : rows) {
    if (row.softness > 0 || row.lower > -kInf || row.upper < kInf) continue;
    if (row.b == body) guides.push_back({row.second, row.speed - along(row.a, row.first)});
    if (row.a == body) guides.push_back({row.first, row.speed - along(row.b, row.second)});
  }
}

void keep_impulses(state::HeldJoint& joint, std::span<const ConstraintRow> rows, double dt) {
  for (std::size_t k = 0; k < rows.size(); ++k) joint.impulse[k] = rows[k].impulse;
  joint.motor_force = joint.settings.type == JointType::fixed ? 0 : rows[0].impulse / dt;
}

}  // namespace divot::contact
