#pragma once

#include <cstdint>
#include <span>

#include "divot/jobs.h"
#include "divot/settings.h"
#include "laws/ground.h"
#include "laws/medium.h"
#include "state/blasts.h"
#include "state/motion.h"
#include "state/particles.h"
#include "state/soil.h"

// stage     forces: every force on every awake particle
// reads     motion, bonds, soil at rest, media, blasts
// writes    force, held_pull
// parallel  over particles, then over what each blast pushes
// sums      a particle's bonds in ascending order of neighbour, then damping, ground, blasts in order of detonation
namespace divot::forces {

/// What forces need besides where particles are.
struct Field {
  const state::Bonds& bonds;
  const state::Soil& soil;
  std::span<const laws::Medium> media;
  std::span<const state::Blast> blasts;
  Cohesion cohesion = Cohesion::lennard_jones;
  float cutoff = 0;  ///< m
  laws::Resolution resolution;
};

/// Forces at `time`, s, for particles that are where `motion` says. Particles held by a body or as anchors get none;
/// `held_pull` keeps what cohesion does to those a body carries.
void evaluate(state::Particles& particles, const state::MotionView& motion, double time, const Field& field,
              const Jobs& jobs);

/// Lets what was strained too far flow: bonds take a new rest length beyond their yield strain, soil on Bekker's curve
/// keeps its sinkage, soil pulled or sheared beyond its strength follows. Called after each substep.
void yield(const state::Particles& particles, state::Bonds& bonds, state::Soil& soil,
           std::span<const laws::Medium> media, const laws::Resolution& resolution, const Jobs& jobs);

/// Shape of a blast's pressure pulse at `time`: 1 falling linearly to 0 over the pulse.
float pulse_shape(const state::Blast& blast, double time);

}  // namespace divot::forces
