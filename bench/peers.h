#pragma once

#include <functional>
#include <string>
#include <vector>

#include "divot/errors.h"

namespace divot::bench {

/// What one program or library took for one thing.
struct PeerTime {
  std::string task;  ///< `forces`: what is compared
  std::string who;   ///< `divot`, `Embree refit`
  double ns = 0;     ///< CPU time of one thread for each of `count`; 0: not installed
  std::size_t count = 0;
  std::string each;     ///< what is counted: `particle and step`
  std::string missing;  ///< why there is no time
};

/// Median CPU time of one thread over calls of `work`, ns. At least five calls and a tenth of a second.
double cpu_ns(const std::function<void()>& work);

// Each appends divot's time first, then its peers' for the same data.

/// Forces on a sheet of particles, one evaluation: LAMMPS (`lmp`).
Result<void> compare_forces(std::vector<PeerTime>& times);
/// Rows of neighbours of that sheet: nanoflann.
Result<void> compare_neighbours(std::vector<PeerTime>& times);
/// A million triangles that follow a surface, and balls that ask for those they touch: Embree, Bullet.
Result<void> compare_surfaces(std::vector<PeerTime>& times);
#ifdef DIVOT_HAS_EMBREE
/// Embree's part of it.
struct SurfaceTask;
void compare_embree(const SurfaceTask& task, std::vector<PeerTime>& times);
#endif
/// A ball that rolls, one step: Bullet on a height field that nothing deforms.
Result<void> compare_rolling(const std::string& scenes, std::vector<PeerTime>& times);

}  // namespace divot::bench
