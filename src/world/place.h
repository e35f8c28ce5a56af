#pragma once

#include <optional>

#include "divot/scene.h"
#include "geometry/solid.h"
#include "world/state.h"

namespace divot::place {

/// A body as it comes into a world.
struct Placed {
  std::shared_ptr<const geometry::Solid> solid;
  Vec3d origin;  ///< of the shape, m, relative to the surface's origin; z as the scene has it
};

/// Makes what a body is from what it was given. False where a hull spans no volume.
bool embody(state::Body& body);

/// What the settings say of a body, with the files its shape needs read. Fails naming the file or the shape.
Result<state::Body> prepare(const World::Impl& w, const BodySettings& settings);

/// Where the settings put it.
Placed placed(const World::Impl& w, const BodySettings& settings, const state::Body& body);

/// Height above `origin` (z = 0) by which the body must be lifted so that it just rests on the ground; nothing where
/// there is none below it. [O(vertices below it)]
std::optional<double> lift(const World::Impl& w, const BodySettings& body, const Placed& placed);

/// Whether a body that comes into the world stands still on the ground, to a hundredth of its radius.
bool is_set_down(const World::Impl& w, const BodySettings& body, const Placed& placed);

/// What is wrong with the body's place, if anything.
Result<void> check_place(const World::Impl& w, const BodySettings& body, const Placed& placed);

/// The error of a place without ground, which says where there is some.
Error no_ground(const World::Impl& w, std::string key, const Vec3d& place);

}  // namespace divot::place
