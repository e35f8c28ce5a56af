#pragma once

#include <span>
#include <vector>

#include "divot/scene.h"
#include "divot/world.h"
#include "geometry/bvh.h"
#include "laws/medium.h"
#include "state/blasts.h"
#include "state/particles.h"
#include "state/region.h"
#include "state/soil.h"
#include "state/surface.h"

// stage     events: bombs whose time has come, ground that is pushed
// reads     surface, media
// writes    blasts, columns of the ground they reach, the particles' list of what to wake
// parallel  no: bombs go off one after another, in order of time, then of the scene
// sums      over vertices in ascending order
namespace divot::events {

/// The step in which a bomb goes off.
struct Moment {
  double time = 0;     ///< s
  double dt = 0;       ///< s
  double gravity = 0;  ///< m/s^2, >= 0
};

/// What a bomb does to the ground. A blast that reaches no vertex pushes nothing and is inactive.
/// `bomb.position` is in the terrain's coordinates; to the paper's model a burst below the ground is one at the ground.
/// Charges of the scaled model whose ground is not at rest yet (`earlier`) make a common crater with it where both
/// reach.
state::Blast detonate(const Bomb& bomb, Blast model, const Moment& moment, std::span<state::Blast> earlier,
                      state::Surface& surface, state::Soil& soil, const geometry::Bvh& bvh,
                      std::span<const laws::Medium> media, state::RegionScratch& scratch);

/// Ground that the blast pushes is let go by what carried it and, in the scaled model, flows until it comes to rest.
/// For the step in which it went off, when all that it pushes is awake.
void loosen(const state::Blast& blast, const state::Soil& soil, state::Particles& particles);

/// Velocity that a push gives one vertex.
struct Kick {
  std::uint32_t vertex = 0;
  Vec3 velocity;  ///< m/s
};

/// Appends what a push gives to each vertex it reaches, ascending by vertex.
void push_ground(const GroundPush& push, const state::Surface& surface, const geometry::Bvh& bvh,
                 state::RegionScratch& scratch, std::vector<Kick>& kicks);

/// Hands the kicks to their particles, which must be awake, and clears them. What a body carries keeps its velocity.
void kick(std::vector<Kick>& kicks, const state::Surface& surface, const state::Soil& soil,
          state::Particles& particles);

}  // namespace divot::events
