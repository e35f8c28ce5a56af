#pragma once

#include <optional>
#include <osg/Group>

#include "viewer/camera.h"
#include "viewer/input.h"

namespace divot::viewer {

/// Where the ground is at a place of the window, m, in the terrain's coordinates; nothing beside it. `aspect`: width
/// over height of the window. `reach`: m, how far from the eye. [O(triangles of chunks on the ray)]
std::optional<Vec3d> pick_ground(osg::Group& ground, const Vec3d& origin, const Camera& camera, double aspect,
                                 const WindowPoint& at, double reach);

}  // namespace divot::viewer
