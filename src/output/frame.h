#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "divot/world.h"

namespace divot::output {

/// The ground at one instant, as files need it: a copy, so that the world may step on while it is written.
struct Frame {
  double time = 0;  ///< s
  Vec3d origin;     ///< m: add to a position for the terrain's own coordinates
  double spacing = 0;
  std::vector<Vec3> positions;                                  ///< [vertex] m, relative to origin
  std::vector<std::uint8_t> materials;                          ///< [vertex]
  std::vector<float> sinkage;                                   ///< [vertex] m
  std::shared_ptr<const std::vector<std::uint32_t>> triangles;  ///< [3 * face]; frames share them while they last

  // What is awake, ascending by vertex.
  std::vector<std::uint32_t> awake;  ///< [particle] vertex
  std::vector<Vec3> velocity;        ///< [particle] m/s
  std::vector<float> pressure;       ///< [particle] Pa

  std::optional<RasterView> raster;  ///< where it was asked for and the terrain has one

  SurfaceView surface() const { return {origin, positions, *triangles, materials, spacing}; }
  std::size_t bytes() const;  ///< of memory, about
};

/// Copies the ground as it is now. `last` may lend its triangles; `with_raster` asks for the raster. [O(vertices)]
Frame take_frame(const World& world, const Frame* last, bool with_raster);

}  // namespace divot::output
