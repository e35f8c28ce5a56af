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

/// What a bomb does to the ground at `time`, s. A blast that reaches no vertex pushes nothing and is inactive.
/// `bomb.position` is in the terrain's coordinates; a burst below the ground counts as one at the ground.
state::Blast detonate(const Bomb& bomb, Blast model, double time, double dt, state::Surface& surface, state::Soil& soil,
                      const geometry::Bvh& bvh, std::span<const laws::Medium> media, state::RegionScratch& scratch);

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
