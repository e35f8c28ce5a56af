#pragma once

#include <array>
#include <span>
#include <vector>

#include "contact/columns.h"
#include "contact/joint_rows.h"
#include "contact/resistance.h"
#include "contact/rigid_bodies.h"
#include "core/hash_set.h"
#include "divot/jobs.h"
#include "divot/settings.h"
#include "geometry/bvh.h"
#include "geometry/posed_solid.h"
#include "laws/medium.h"
#include "math/six.h"
#include "state/bodies.h"
#include "state/particles.h"
#include "state/region.h"
#include "state/soil.h"
#include "state/surface.h"

// stage     contact: bodies x surface
// reads     surface, BVH, soil, particles, media
// writes    bodies, joints, list of vertices to wake; then (carry) particles and soil under the bodies
// parallel  over bodies while they look for ground and meet it; Bullet moves them together
// sums      a body's columns in ascending order of vertex
namespace divot::contact {

/// A column of soil within a body's reach, gathered once a step from surface, soil and particles. Heights are those of
/// the plane through the column's vertex at the point where the body meets it.
struct Footing {
  std::uint32_t vertex = 0;
  std::uint8_t material = 0;
  bool carried = false;  ///< a body has it since the last step
  double x = 0, y = 0;   ///< m: where the body meets it; at the vertex, but under what rolls on its line of touch
  double arm_x = 0, arm_y = 0;  ///< m: where its push acts; the middle of its part under the body's edge, else x, y
  Vec3 vertex_position;         ///< m
  double above_vertex = 0;      ///< m, of the plane at x, y over the vertex
  double height = 0;            ///< m: a body at or above it touches nothing
  double fresh = 0;             ///< m: sinkage counts from here, less slack
  double original = 0;          ///< m, before the first touch
  double plastic = 0;           ///< m, permanent sinkage
  double slack = 0;             ///< m the column stands too deep for its last pressure: gives no push
  double area = 0, mass = 0;    ///< m^2, of the part that the body covers where its edge cuts through; kg
  double pull = 0, speed = 0;   ///< N, m/s: of the particle by its bonds, and upward
  Vec3d shear;                  ///< m, shear displacement j
};

/// A row from a body's velocity and spin to a speed at one contact.
using math::dot6;
using math::Row;

/// Soil that stands before a piece of a body's upright side and resists being pushed on by it.
struct Wall {
  Row inward{};      ///< from the body's velocity to the speed at which the wall goes into the soil, m/s
  double force = 0;  ///< N, once it does
};

/// Where a body has pressed one column to.
struct Press {
  std::uint32_t vertex = 0;
  Vec3 position;       ///< of the surface at the end of the step, m
  Vec3 shear;          ///< shear displacement j, m
  float plastic = 0;   ///< m
  float pressure = 0;  ///< Pa, by which it answered
  float load = 0;      ///< N, its push upward
};

/// Arrays the stage needs; they grow and stay. One set a body.
struct Scratch {
  struct PerBody {
    state::RegionScratch region;
    geometry::PosedSolid start, end;  // the body at the start of the step and where it is expected at its end
    std::vector<std::uint32_t> found, ring;
    core::HashSet met;  // of vertices
    std::vector<Footing> footings;
    Vec3d ground{0, 0, 1};                // across the unpressed ground under the body, 1 high
    std::vector<geometry::Cover> covers;  // [footing] area, and area times place
    Columns columns;                      // [footing]
    ColumnTask task;
    std::vector<double> loads;  // [column] N, before a pass
    std::vector<Wall> walls;
    std::vector<Guide> guides;
    std::vector<Press> presses, last;
    struct Start {
      double height = 0;  ///< m
      Vec3d shear;        ///< m
    };
    std::vector<Start> at_start;  ///< [footing] of a step that is met in parts, else empty
    Row gain{};  ///< m/s, rad/s: velocity at the end of such a step over the mean one with which the body is moved
  };
  std::vector<PerBody> bodies;
  struct Pose {
    Vec3d position;
    Quat orientation;
  };
  std::vector<Pose> before;            // [body] where it was at the start of the step
  std::vector<Resistance> resistance;  // [body]
  std::vector<ConstraintRow> rows;     // of all joints, one after the other
  std::vector<std::size_t> first_row;  // [joint + 1]
};

/// What contact needs to know of the world.
struct Situation {
  const state::Surface& surface;
  const geometry::Bvh& bvh;
  const state::Soil& soil;
  const state::Particles& particles;
  std::span<const laws::Medium> media;
  Vec3d gravity;
  double dt = 0;           ///< s
  float ground_moved = 0;  ///< m, at least as far as ground that no body carries moved in the last step
  UpdatePolicy policy;     ///< adaptive: half-edge walk from the last contact; otherwise the BVH is asked each step
  double time = 0;         ///< s, at the start of the step
};

/// Bodies meet the ground, each other and their joints and move on by dt. Vertices that a body touches for the first
/// time, and those around them, are appended to `wake`.
void move_bodies(std::span<state::Body> bodies, std::span<state::HeldJoint> joints, RigidBodies& rigid,
                 const Situation& s, std::vector<std::uint32_t>& wake, Scratch& scratch, const Jobs& jobs);

/// Particles under a body go where it pressed them, and the soil remembers. Every pressed vertex must be awake.
void carry(std::span<state::Body> bodies, state::Particles& particles, state::Soil& soil, const state::Surface& surface,
           double dt, const Scratch& scratch);

}  // namespace divot::contact
