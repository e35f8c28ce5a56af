#include <algorithm>

#include "events/events.h"

namespace divot::events {

void push_ground(const GroundPush& push, const state::Surface& surface, const geometry::Bvh& bvh,
                 state::RegionScratch& scratch, std::vector<Kick>& kicks) {
  const Vec3d centre = push.position - surface.origin;
  const float x = static_cast<float>(centre.x), y = static_cast<float>(centre.y);
  const float radius = static_cast<float>(push.radius);
  math::Aabb column;
  column.include(Vec3{x - radius, y - radius, -math::Aabb::kInf});
  column.include(Vec3{x + radius, y + radius, math::Aabb::kInf});
  std::vector<std::uint32_t> vertices;
  state::vertices_near(surface, bvh, column, scratch, vertices);

  // (1 - (r/R)^2)^2 ends with neither a step nor a kink.
  for (const std::uint32_t vertex : vertices) {
    const Vec3& p = surface.position[vertex];
    const float inside = 1 - ((p.x - x) * (p.x - x) + (p.y - y) * (p.y - y)) / (radius * radius);
    if (inside <= 0 || state::rigid_between(surface, p.x, p.y, static_cast<float>(centre.z), p.z, scratch)) continue;
    const Vec3 velocity = inside * inside *
                          Vec3{static_cast<float>(push.velocity.x), static_cast<float>(push.velocity.y),
                               static_cast<float>(push.velocity.z)};
    kicks.push_back({vertex, velocity});
  }
}

void kick(std::vector<Kick>& kicks, const state::Surface& surface, const state::Soil& soil,
          state::Particles& particles) {
  for (const Kick& kick : kicks) {
    const std::uint32_t i = soil.particle[surface.column[kick.vertex]];
    if (particles.hold[i] == Hold::free) particles.set_velocity(i, particles.velocity(i) + kick.velocity);
  }
  kicks.clear();
}

}  // namespace divot::events
