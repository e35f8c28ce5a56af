#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "divot/ids.h"
#include "divot/vec.h"

namespace divot {

/// A value that may change with time: linear between its points, held before the first and after the last.
struct Profile {
  std::vector<std::pair<double, double>> points = {{0, 0}};  ///< (time s, value), times ascending; at least one

  Profile() = default;  ///< 0 at all times
  /// The same at all times.
  Profile(double value) : points{{0, value}} {}
  /// Through the points of a list.
  Profile(std::vector<std::pair<double, double>> list) : points(std::move(list)) {}
  /// Value at a time, s; 0 without points.
  double at(double time) const;
};

/// What two bodies may still do against each other.
enum class JointType : std::uint8_t {
  hinge,   ///< turn about `axis`
  slider,  ///< move along `axis`
  fixed,   ///< nothing
  spring,  ///< move along `axis` against a spring
  wheel    ///< a wheel's suspension: `second` moves along `axis` against a spring, spins about `axle`, is steered
};

/// Holds `second` to `first`. Anchor and axes are in the axes of `second` as it stands when the joint is made, so that
/// a joint goes with its bodies wherever they are placed.
struct Joint {
  std::string name = {};              ///< names it for programs; may be empty
  JointType type = JointType::hinge;  ///< what it leaves free
  std::string first = {};             ///< name of a body; empty: the terrain itself
  std::string second = {};            ///< name of the body that is held
  Vec3d anchor = {};                  ///< from the position of `second`, m
  Vec3d axis = {0, 0, 1};             ///< of turning or travel, any length > 0
  Vec3d axle = {0, 1, 0};             ///< of a wheel's spin, across `axis`
  double stiffness = 0;               ///< of a spring's or wheel's travel, N/m, >= 0
  double damping = 0;                 ///< likewise, N s/m, >= 0
  double preload = 0;                 ///< force of the spring where the joint is made, along `axis` on `first`, N
  std::optional<double> lower = {};   ///< least travel of `second` along `axis`, m; hinge: angle, degrees
  std::optional<double> upper = {};   ///< largest
  Profile motor_speed = {};   ///< what the motor strives for: m/s along `axis`; hinge, wheel: rad/s about axis, axle
  Profile motor_force = {};   ///< the most it gives, N, or N m; 0: no motor
  Profile steering_deg = {};  ///< angle of a wheel about `axis`, degrees
  bool collide = false;       ///< whether the two bodies still collide with each other
};

/// A joint of a world. Ids count up from 0 in order of creation and are never reused.
struct JointId {
  std::uint32_t value = kNone;  ///< its place in World::joints()
  /// The same joint.
  friend bool operator==(const JointId&, const JointId&) = default;
};

}  // namespace divot
