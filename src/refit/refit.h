#pragma once

#include <cstdint>
#include <vector>

#include "divot/jobs.h"
#include "divot/settings.h"
#include "geometry/bvh.h"
#include "state/particles.h"
#include "state/surface.h"

// stage     refit: the bounding volume hierarchy follows the ground
// reads     surface, how far it moved
// writes    BVH
// parallel  no
// sums      none
namespace divot::refit {

/// The hierarchy over the faces that the surface started with, and what has moved since it was last right. What such a
/// face was halved into is found below it (state::faces_near).
struct Tree {
  geometry::Bvh bvh;
  float margin = 0;                     ///< m by which leaf boxes are larger than their faces
  std::vector<std::uint32_t> moved;     ///< vertices that moved since, each once
  std::vector<std::uint64_t> is_moved;  ///< [vertex / 64] bits: in `moved`
  float drift = 0;                      ///< m, at least as far as any of them moved
  std::uint64_t steps = 0, refits = 0, rebuilds = 0;
};

/// Boxes around the surface as it stands.
void build(Tree& tree, const state::Surface& surface, const Jobs& jobs);

/// A hierarchy whose boxes have grown by so much since it was built is built anew.
inline constexpr float kWorn = 1.5f;

/// Brings the tree up to date as the policy says. `moved`: vertices that moved in this step, none further than
/// `distance`, m. Adaptive boxes stay right for as long as nothing has moved further than their margin, then only those
/// that were left are refitted.
void update(Tree& tree, const state::Surface& surface, const std::vector<std::uint32_t>& moved, float distance,
            const UpdatePolicy& policy, const Jobs& jobs);

}  // namespace divot::refit
