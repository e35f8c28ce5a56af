#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "divot/ids.h"
#include "divot/vec.h"
#include "geometry/solid.h"

namespace divot::state {

/// A rigid body and what it touches. Positions are relative to the surface's origin, and those of its centre of mass;
/// its axes are its principal axes of inertia.
struct Body {
  std::string name;
  std::shared_ptr<const geometry::Solid> solid;  ///< never null
  std::shared_ptr<const Shape> shape;            ///< as it is drawn
  /// What both are made of: hulls have their points; centre of mass and inertia of a kilogram where they are given.
  Shape given_shape;
  std::optional<Vec3d> given_center, given_inertia;
  double radius = 1, mass = 1;      // m, of the ball round its centre of mass that holds it; kg
  Vec3d inertia = {0.4, 0.4, 0.4};  // kg m^2, about its axes
  double restitution = 0.5, friction = 0.8;
  Vec3d position, velocity, angular_velocity;  // m, m/s, rad/s; contact/
  Quat orientation;

  // refine/
  double edge = 0;     ///< m, of the finest triangles that it wants under it
  double spacing = 1;  ///< m, of those it has; of the terrain where nothing is refined
  Vec3d refined_from,
      refined_to;            ///< m: on this way, and as far beside it as `refined_left`, the ground is fine enough
  double refined_left = -1;  ///< m; negative: look again

  // contact/
  std::vector<std::uint32_t>
      near;               ///< vertices that could touch it before it or they have moved by `near_left`, ascending
  double near_left = -1;  ///< m; negative: look again
  std::uint32_t last_vertex = kNone;  ///< where the half-edge walk starts: last contact
  bool touching = false;              ///< pressed ground at the end of the last step
  double patch_width = 0;   ///< b of Bekker's law, m: radius of a round patch that it touches, smaller side of others
  double weight_share = 1;  ///< grows to 1 while it is set down, and with it, smoothly, what it has of its weight
  Vec3d way;                ///< m, that it went in this step; at the end of an impact the velocity is another
  double impact_speed = 0;  ///< m/s, what restitution gives back a share of; 0 when nothing is owed
  /// N s and N m s, of joints and other bodies: what the next step starts from, and what the last one had
  std::array<double, 6> held_impulse{}, last_impulse{};
  double sinkage = 0, max_sinkage = 0;  ///< m below the original ground
  bool off_terrain = false;
};

}  // namespace divot::state
