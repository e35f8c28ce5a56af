#pragma once

#include <memory>
#include <span>

#include "state/bodies.h"

namespace divot::contact {

/// Bodies among themselves: Bullet's rigid body dynamics, without gravity, which comes with the soil's answer.
class RigidBodies {
 public:
  RigidBodies();
  ~RigidBodies();
  RigidBodies(RigidBodies&&) noexcept;
  RigidBodies& operator=(RigidBodies&&) noexcept;

  /// A body is known here by its place in the span that advance() gets.
  void add(const state::Body& body);

  /// Moves all bodies by `dt`, s, with the velocities they have; where two collide, Bullet changes both.
  void advance(std::span<state::Body> bodies, double dt);

 private:
  struct Bullet;
  std::unique_ptr<Bullet> bullet_;
};

}  // namespace divot::contact
