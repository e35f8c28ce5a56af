#include "output/frame.h"

#include <algorithm>

namespace divot::output {
namespace {

// Those of the frame before, unless the ground has new ones since.
std::shared_ptr<const std::vector<std::uint32_t>> share_triangles(std::span<const std::uint32_t> now,
                                                                  const Frame* last) {
  if (last != nullptr && std::ranges::equal(*last->triangles, now)) return last->triangles;
  return std::make_shared<const std::vector<std::uint32_t>>(now.begin(), now.end());
}

}  // namespace

std::size_t Frame::bytes() const {
  const std::size_t pixels = raster ? raster->heights.size() : 0;
  return positions.size() * (sizeof(Vec3) + sizeof(float) + 1) + awake.size() * (sizeof(Vec3) + 2 * sizeof(float)) +
         pixels * (3 * sizeof(float) + 1);
}

Frame take_frame(const World& world, const Frame* last, bool with_raster) {
  const SurfaceView surface = world.surface();
  const ParticleView particles = world.particles();
  Frame frame{.time = world.time(),
              .origin = surface.origin,
              .spacing = surface.spacing,
              .positions = {surface.positions.begin(), surface.positions.end()},
              .materials = {surface.materials.begin(), surface.materials.end()},
              .sinkage = std::vector<float>(surface.positions.size()),
              .triangles = share_triangles(surface.triangles, last)};
  for (std::uint32_t v = 0; v < frame.sinkage.size(); ++v) frame.sinkage[v] = world.sinkage(v);
  for (std::size_t i = 0; i < particles.vertices.size(); ++i) {
    if (particles.hold[i] == Hold::anchor) continue;
    frame.awake.push_back(particles.vertices[i]);
    frame.velocity.push_back({particles.vx[i], particles.vy[i], particles.vz[i]});
    frame.pressure.push_back(world.pressure(particles.vertices[i]));
  }
  if (with_raster) frame.raster = world.raster(world.scene().output.raster_spacing);
  return frame;
}

}  // namespace divot::output
