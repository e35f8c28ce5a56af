#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/bvh.h"
#include "geometry/posed_solid.h"
#include "laws/medium.h"
#include "refine/halve.h"
#include "state/blasts.h"
#include "state/bodies.h"
#include "state/particles.h"
#include "state/soil.h"
#include "state/surface.h"

// stage     refine: triangles as fine as what bodies and bombs are about to do, and no finer than what they did
// reads     bodies, bombs about to go off, BVH, media
// writes    surface with its triangles, soil, rows of particles, blasts' lists
// parallel  no: triangles are halved one after another, those round bodies first
// sums      none; what is halved or joined keeps all sums
namespace divot::refine {

/// How fine the ground may get. Edges are legs of right triangles on a grid; elsewhere shorter sides may be a little
/// longer or shorter.
struct Limits {
  double edge = 0;             ///< m, no triangle is halved that is as fine as this
  double base = 0;             ///< m, of the triangles that the terrain started with
  float tolerance = 1e-3f;     ///< m, by which the surface may move where triangles are joined again
  float relief_share = 0.01f;  ///< or this share of what the ground there was deformed by
  std::uint32_t budget = 0;    ///< most vertices beyond those that the terrain started with
};

/// Ground that a bomb is about to deform.
struct Zone {
  Vec3 centre;        ///< m, relative to the surface's origin; the height does not matter
  double radius = 0;  ///< m, of the crater
  double edge = 0;    ///< m, wanted in it; further out the wanted edge grows
};

/// The step that is about to be made.
struct Step {
  double dt = 0;       ///< s
  double gravity = 0;  ///< m/s^2, >= 0
};

/// What the stage remembers from step to step.
struct Progress {
  std::uint32_t next = 0;                ///< added vertex to be looked at next, counted from the first
  std::uint64_t halved = 0, joined = 0;  ///< vertices that came and went so far
  std::uint32_t most = 0;                ///< added vertices at once
  std::uint64_t short_steps = 0;         ///< steps in which ground was coarser than wanted, for lack of budget
};

/// Arrays the stage needs; they grow and stay.
struct Scratch {
  geometry::PosedSolid posed;
  std::vector<std::uint32_t> faces;
  std::vector<std::uint32_t> touched;  ///< vertices that came or went in the step
};

/// What a step has changed.
struct Outcome {
  bool rows = false;           ///< rows of particles: their indices are other ones
  bool out_of_budget = false;  ///< somewhere triangles are coarser than they should be
};

/// Halves triangles in the way of bodies (Body::refined_from) and in `zones`; then, if it `may_join`, looks at some of
/// those that were halved before and joins them where the ground is flat enough. What is awake, or near a body, stays.
/// As the budget is used up, more is flat enough. Where it does not suffice, the ground gets edges of twice the length
/// that was wanted, or four times and so on, for which a share of the budget is kept: Body::spacing says which.
/// [O(bodies that have moved on by their reach * triangles there + added vertices / 256)]
Outcome update(Ground& ground, const geometry::Bvh& bvh, std::span<state::Body> bodies, std::span<const Zone> zones,
               const Limits& limits, const Step& step, bool may_join, Progress& progress, Scratch& scratch);

}  // namespace divot::refine
