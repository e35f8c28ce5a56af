#include <cmath>
#include <numbers>

#include "core/assert.h"
#include "scene/check.h"
#include "world/state.h"

namespace divot {
namespace {

std::uint32_t index_of(const std::vector<state::Body>& bodies, const std::string& name) {
  for (std::uint32_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].name == name) return i;
  return kNone;
}

// x along the axis, y along the part of the axle across it: for joints without an axle, any direction across.
Quat axes_of(const Joint& joint) {
  const Vec3d x = joint.axis * (1 / length(joint.axis));
  Vec3d across = joint.type == JointType::wheel ? joint.axle : Vec3d{};
  if (!(length(across) > 0)) across = std::abs(x.x) < 0.7 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d y = across - dot(across, x) * x, unit = y * (1 / length(y));
  return math::from_columns(x, unit, cross(x, unit));
}

}  // namespace

Result<JointId> World::add_joint(const Joint& joint) {
  Scene named;
  for (const state::Body& body : impl_->bodies) named.bodies.push_back({.name = body.name});
  named.joints.push_back(joint);
  if (Errors errors = check(named); !errors.empty()) return tl::unexpected(std::move(errors));

  using math::operator*;
  state::HeldJoint held{.settings = joint,
                        .first = index_of(impl_->bodies, joint.first),
                        .second = index_of(impl_->bodies, joint.second)};
  // From the shape's axes, in which the joint is given, to those of the body, then to the world and the other body.
  const state::Body& second = impl_->bodies[held.second];
  held.on_second = {second.solid->origin + math::rotate(second.solid->axes, joint.anchor),
                    second.solid->axes * axes_of(joint)};
  held.on_first = {second.position + math::rotate(second.orientation, held.on_second.anchor),
                   second.orientation * held.on_second.axes};
  if (held.first != kNone) {
    const state::Body& first = impl_->bodies[held.first];
    const Quat back = math::conjugate(first.orientation);
    held.on_first = {math::rotate(back, held.on_first.anchor - first.position), back * held.on_first.axes};
  }
  // What joints hold is carried by others, whose weight comes at once: so does its own.
  for (const std::uint32_t body : {held.first, held.second})
    if (body != kNone) impl_->bodies[body].weight_share = 1;
  impl_->rigid.add(held);
  impl_->joints.push_back(std::move(held));
  impl_->keep(joint);
  return JointId{static_cast<std::uint32_t>(impl_->joints.size() - 1)};
}

void World::set_motor(JointId joint, double speed, double force) {
  DIVOT_ASSERT(joint.value < impl_->joints.size());
  impl_->joints[joint.value].motor = {speed, force};
  impl_->keep(MotorSetting{joint.value, speed, force});
}

void World::set_steering(JointId joint, double angle_deg) {
  DIVOT_ASSERT(joint.value < impl_->joints.size());
  impl_->joints[joint.value].steering_deg = angle_deg;
  impl_->keep(SteeringSetting{joint.value, angle_deg});
}

std::vector<JointView> World::joints() const {
  std::vector<JointView> views;
  for (const state::HeldJoint& j : impl_->joints) {
    const double unit = j.settings.type == JointType::hinge ? 180 / std::numbers::pi : 1;
    views.push_back({j.settings.name, j.position * unit, j.speed, j.motor_force});
  }
  return views;
}

}  // namespace divot
