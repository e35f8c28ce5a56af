#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "contact/joint_rows.h"
#include "contact/resistance.h"
#include "laws/medium.h"
#include "state/bodies.h"
#include "state/joints.h"
#include "state/surface.h"

namespace divot::contact {

/// Bodies among themselves: Bullet's rigid body dynamics with joints over soil, without gravity, which comes with the
/// soil's answer.
class RigidBodies {
 public:
  RigidBodies();
  ~RigidBodies();
  RigidBodies(RigidBodies&&) noexcept;
  RigidBodies& operator=(RigidBodies&&) noexcept;

  /// Faces of the ground that stand still, with the friction of `medium`. Bodies meet them from the side that they face
  /// and only along directions that are not up: what bears from below is soil.
  void add(const state::RigidFaces& faces, std::span<const Vec3> positions, const laws::Medium& medium);

  /// A body is known here by its place in the span that advance() gets.
  void add(const state::Body& body);

  /// Two bodies of a joint collide no more, unless the joint says so.
  void add(const state::HeldJoint& joint);

  /// Moves all bodies by `dt`, s, with the velocities they have; where joints hold them or two collide, these change,
  /// against what resists. The impulses found come back in the joints' rows.
  void advance(std::span<state::Body> bodies, std::span<ConstraintRow> rows, std::span<const Resistance> resistance,
               double dt);

  /// What joints and other bodies gave a body in the last step, N s and N m s; nothing where it had neither.
  std::optional<math::Row> impulse(std::size_t body) const;

  /// All that is kept here from one step to the next, as bytes, and back: where bodies touch each other and how hard.
  /// False where the bytes are not of that kind.
  std::string save() const;
  bool restore(std::string_view bytes);

 private:
  struct Bullet;
  std::unique_ptr<Bullet> bullet_;
};

}  // namespace divot::contact
