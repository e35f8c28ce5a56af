#pragma once

#include <cstdint>
#include <span>

#include "divot/scene.h"

namespace divot::scene {

/// A number that two scenes share only where a run of one is a run of the other: over every key of the scene file but
/// `duration` and those of `output`, and over `used`, the materials its ground is made of. What only the C++ interface
/// can set - heights, meshes and points in memory - is left out.
std::uint64_t fingerprint(const Scene& scene, std::span<const Material> used);

}  // namespace divot::scene
