#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "divot/joint.h"

namespace divot::state {

/// Axes and anchor of a joint as one of its bodies carries them: in the body's axes from its centre of mass, or those
/// of the world from the surface's origin.
struct JointFrame {
  Vec3d anchor;  // m
  Quat axes;     // x: axis of turning or travel, y: axle
};

/// Two bodies held together.
struct HeldJoint {
  Joint settings;
  std::uint32_t first = kNone, second = kNone;  // indices of bodies; first kNone: the world
  JointFrame on_first, on_second;
  std::optional<std::pair<double, double>> motor;  // speed and force that replace the profiles'
  std::optional<double> steering_deg;              // replaces the profile

  // contact/
  static constexpr int kMostRows = 9;
  std::array<double, kMostRows> impulse{};  // N s or N m s, of the last step: where the next one starts
  double turn = 0;                          // rad, of a hinge, counted on beyond a whole turn
  double position = 0, speed = 0;           // m or rad, of travel or turn; m/s or rad/s, of travel, turn or spin
  double motor_force = 0;                   // N or N m
};

}  // namespace divot::state
