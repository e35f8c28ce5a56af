#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "divot/world.h"

namespace divot::output {

/// The ground as a report draws it: where its vertices started and how far they have moved.
struct ShownGround {
  std::vector<Vec3> start;               ///< [vertex] m, relative to the surface's origin
  std::vector<Vec3> offset;              ///< [vertex] m
  std::vector<std::uint32_t> triangles;  ///< [3 * face]
  std::vector<std::uint8_t> materials;   ///< [vertex]
  std::uint32_t stride = 1;              ///< of a raster: every so manieth node is shown
};

/// The surface itself, or, where it has more than `most_vertices` and came from a raster, a coarser grid over it.
/// [O(vertices)]
ShownGround shown_ground(const World& world, std::size_t most_vertices);

/// What a report's page reads of a mesh: start (float), triangles (uint32), materials (uint8), deflated.
std::string packed_mesh(const ShownGround& ground);

/// What it reads of a time: the vertices that moved (uint32) and how far (3 x int16, in steps of `step` m), deflated.
struct PackedFrame {
  std::string bytes;
  std::size_t moved = 0;
  double step = 1;
};
PackedFrame packed_frame(const ShownGround& ground);

/// `bytes` as base64.
std::string base64(const std::string& bytes);

}  // namespace divot::output
