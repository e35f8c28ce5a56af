#pragma once

#include "scene/visitor.h"

namespace divot::scene {

/// Shows `visitor` every key of a scene file with its unit, range, meaning and place in `scene`. This is the only list
/// of keys: reading, checking, error messages and docs/scene-format.md all come from it.
void describe(Visitor& visitor, Scene& scene);

/// The keys of one material, without its base.
void describe(Visitor& visitor, Material& material);

/// The keys of one body, joint and bomb.
void describe(Visitor& visitor, BodySettings& body);
void describe(Visitor& visitor, Joint& joint);
void describe(Visitor& visitor, Bomb& bomb);

}  // namespace divot::scene
