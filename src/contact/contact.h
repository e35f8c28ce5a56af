#pragma once

#include <span>
#include <vector>

#include "contact/rigid_bodies.h"
#include "divot/jobs.h"
#include "divot/settings.h"
#include "geometry/bvh.h"
#include "laws/medium.h"
#include "state/bodies.h"
#include "state/particles.h"
#include "state/region.h"
#include "state/soil.h"
#include "state/surface.h"

// stage     contact: bodies x surface
// reads     surface, BVH, soil, particles, media
// writes    bodies, list of vertices to wake; then (carry) particles and soil under the bodies
// parallel  over bodies while they look for ground and meet it; Bullet moves them together
// sums      a body's columns in ascending order of vertex
namespace divot::contact {

/// One column under a body: where the body has pressed it to.
struct Press {
  std::uint32_t vertex = 0;
  Vec3 position;      ///< of the surface at the end of the step, m
  Vec3 shear;         ///< shear displacement j, m
  float plastic = 0;  ///< m
};

/// What a body finds under it: gathered once a step, so that the solve runs over plain arrays.
struct Ground {
  std::vector<std::uint32_t> vertex;  ///< ascending
  std::vector<std::uint8_t> material;
  std::vector<std::uint8_t> carried;  ///< 1: a body has it since the last step
  std::vector<double> x, y;           ///< m
  std::vector<double> height;         ///< m: at or above it nothing is touched
  std::vector<double> fresh;          ///< m: sinkage counts from here
  std::vector<double> original;       ///< m, before the first touch
  std::vector<double> plastic, area, mass, pull, speed;  ///< m, m^2, kg, N, m/s (vertical)
  std::vector<Vec3d> shear;           ///< m
  std::size_t deepest = 0;            ///< the one the body is furthest over or in
};

/// Arrays the stage needs; they grow and stay. One set a body.
struct Scratch {
  struct PerBody {
    state::RegionScratch region;
    std::vector<std::uint32_t> found, previous, ring, next;
    Ground ground;
    std::vector<Press> presses, last;
  };
  std::vector<PerBody> bodies;
  std::vector<Vec3d> before;  // [body] where it was at the start of the step
};

/// What contact needs to know of the world.
struct Situation {
  const state::Surface& surface;
  const geometry::Bvh& bvh;
  const state::Soil& soil;
  const state::Particles& particles;
  std::span<const laws::Medium> media;
  Vec3d gravity;
  double dt = 0;                 ///< s
  float ground_moved = 0;        ///< m, at least as far as ground that no body carries moved in the last step
  UpdatePolicy policy;           ///< adaptive: half-edge walk from the last contact; otherwise the BVH is asked each step
};

/// Bodies meet the ground and each other and move on by dt. Vertices that a body touches for the first time, and those
/// around them, are appended to `wake`.
void move_bodies(std::span<state::Body> bodies, RigidBodies& rigid, const Situation& s, std::vector<std::uint32_t>& wake, Scratch& scratch,
                 const Jobs& jobs);

/// Particles under a body go where it pressed them, and the soil remembers. Every pressed vertex must be awake.
void carry(std::span<state::Body> bodies, state::Particles& particles, state::Soil& soil, const state::Surface& surface, double dt,
           const Scratch& scratch);

}  // namespace divot::contact
