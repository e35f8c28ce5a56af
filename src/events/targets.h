#pragma once

#include <vector>

#include "geometry/bvh.h"
#include "state/blasts.h"
#include "state/region.h"
#include "state/surface.h"

namespace divot::events {

/// A vertex as a blast sees it.
struct Target {
  std::uint32_t vertex;
  double radius;  ///< from ground zero, along the ground, m
  double above;   ///< height over ground zero, against the blast's direction, m
  double x, y;    ///< from ground zero on the map, m
};

/// Every vertex within `reach` of ground zero, ascending, seen along the blast's direction.
std::vector<Target> targets(const state::Blast& blast, double reach, const state::Surface& surface,
                            const geometry::Bvh& bvh, state::RegionScratch& scratch);

/// A vertex as a blast sees it, in reach or not.
Target seen(const state::Blast& blast, std::uint32_t vertex, const state::Surface& surface);

/// The ground faces a blast with the mean slope of what it reaches, so that one bump under the bomb does not turn the
/// crater. Unit, into the ground.
Vec3 into_ground(const state::Surface& surface, const std::vector<Target>& reached);

}  // namespace divot::events
