#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "divot/jobs.h"
#include "divot/settings.h"
#include "forces/kernel.h"
#include "laws/ground.h"
#include "laws/medium.h"
#include "state/blasts.h"
#include "state/motion.h"
#include "state/particles.h"
#include "state/soil.h"

// stage     forces: every force on every awake particle, and what yields to it
// reads     motion, soil at rest, media, blasts
// writes    force, held_pull, rest lengths of bonds, soil
// parallel  over blocks of eight particles, then over what each blast pushes
// sums      a particle's bonds in ascending order of neighbour, then damping, ground, blasts in order of detonation
namespace divot::forces {

/// What forces need besides where particles are.
struct Field {
  const state::Soil& soil;
  std::span<const laws::Medium> media;
  std::span<const state::Blast> blasts;
  Cohesion cohesion = Cohesion::lennard_jones;
  float cutoff = 0;  ///< m
  laws::Resolution resolution;
};

/// Arrays the stage needs; they grow and stay.
struct Scratch {
  std::vector<Terms> terms;  ///< [material]
};

/// Whether bonds change before they pull: once a substep, where it starts.
enum class Renew : bool { no, yes };

/// A substep that follows motion at this rate, 1/s, softens nothing.
inline constexpr float kFollowsAll = 1e17f;

/// Forces at `time`, s, for particles that are where `motion` says. Particles held by a body or as anchors get none;
/// `held_pull` keeps what cohesion does to those a body carries. With Renew::yes bonds first take a new rest length
/// where they are strained beyond their yield strain, form between pairs that came into range, at rest as they are, and
/// break where a pair left it or flows. `kernel` changes no bit.
void evaluate(state::Particles& particles, state::Bonds& bonds, const state::MotionView& motion, double time,
              const Field& field, Renew renew, Scratch& scratch, const Jobs& jobs, Kernel* kernel = fastest());

/// Lets ground flow that was strained too far: soil on Bekker's curve keeps its sinkage, soil pulled or sheared beyond
/// its strength follows. Called after each substep.
void yield(const state::Particles& particles, state::Soil& soil, std::span<const laws::Medium> media,
           const laws::Resolution& resolution, const Jobs& jobs);

/// Shape of a blast's pressure pulse at `time`: 1 falling linearly to 0 over the pulse.
float pulse_shape(const state::Blast& blast, double time);

}  // namespace divot::forces
