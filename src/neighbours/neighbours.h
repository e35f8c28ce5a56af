#pragma once

#include <cstdint>
#include <vector>

#include "divot/jobs.h"
#include "divot/settings.h"
#include "geometry/column_grid.h"
#include "geometry/kd_tree.h"
#include "geometry/rows.h"
#include "math/aabb.h"
#include "state/particles.h"

// stage     neighbours: rows of neighbours
// reads     position
// writes    bonds: who could have one, and the rest lengths of those who have
// parallel  over particles
// sums      none; rows ascend by particle
namespace divot::neighbours {

/// When rows are rebuilt and how far they reach, m.
struct Reach {
  float cutoff = 0;  ///< range of cohesion
  float skin = 0;    ///< more than that, so that rows hold every pair in range until two have come nearer by that much
  Neighbours structure = Neighbours::grid;
  UpdatePolicy policy;
};

/// The search structures and what the rows were built from. One for each world.
struct Index {
  geometry::KdTree kd_tree;
  geometry::ColumnGrid grid;
  geometry::Rows rows;
  std::vector<float> x, y;                ///< [particle] where it was when rows were built, m
  std::vector<float> level;               ///< [particle] 0
  std::vector<std::uint32_t> vertex;      ///< [particle] of the rows, ascending
  std::vector<std::uint32_t> old_vertex;  ///< the same of the rows before
  state::Bonds old_bonds;
  std::vector<math::Aabb> drift;     ///< scratch
  std::vector<std::uint32_t> slots;  ///< [block] scratch
  std::uint64_t steps_since_build = 0;
  std::uint64_t rebuilds = 0, missed_pairs = 0;
};

/// Brings the rows up to date as the policy says, and always when the set of particles changed. Rest lengths follow
/// their vertices; pairs that are new to the rows have 0: they bond when forces/ next renews bonds.
void update(const state::Particles& particles, state::Bonds& bonds, Index& index, const Reach& reach,
            bool particles_changed, const Jobs& jobs);

}  // namespace divot::neighbours
