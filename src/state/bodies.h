#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "divot/ids.h"
#include "divot/vec.h"

namespace divot::state {

/// A rigid ball and what it touches. Positions are relative to the surface's origin.
struct Body {
  std::string name;
  double radius = 1, mass = 1, inertia = 0.4;  // m, kg, kg m^2
  double restitution = 0.5, friction = 0.8;
  Vec3d position, velocity, angular_velocity;  // m, m/s, rad/s; contact/
  Quat orientation;

  // contact/
  std::vector<std::uint32_t>
      near;               ///< vertices that could touch it before it or they have moved by `near_left`, ascending
  double near_left = -1;  ///< m; negative: look again
  std::uint32_t last_vertex = kNone;    ///< where the half-edge walk starts: last contact
  bool touching = false;                ///< pressed ground at the end of the last step
  double patch_width = 0;               ///< b of Bekker's law, m: radius of the patch it touches
  double impact_speed = 0;              ///< m/s, what restitution gives back a share of; 0 when nothing is owed
  double sinkage = 0, max_sinkage = 0;  ///< m below the original ground
  bool off_terrain = false;
};

}  // namespace divot::state
