#pragma once

#include <cstdint>
#include <vector>

#include "divot/jobs.h"
#include "geometry/rows.h"
#include "state/particles.h"

namespace divot::neighbours {

/// Lays rows out in blocks of eight, with nobody bonded. Where neighbours stand to their particles alike, as on a grid,
/// a slot holds those that do, and a vector load can take the place of eight loads; else the k-th slot holds the k-th
/// neighbour of each. Rows ascend either way, so that the order of sums does not depend on the layout.
/// `slots` is scratch.
void make_blocks(const geometry::Rows& rows, const std::vector<std::uint8_t>& material,
                 std::vector<std::uint32_t>& slots, state::Bonds& bonds, const Jobs& jobs);

}  // namespace divot::neighbours
