#include "events/targets.h"

#include <algorithm>
#include <cmath>

namespace divot::events {

std::vector<Target> targets(const state::Blast& blast, double reach, const state::Surface& surface,
                            const geometry::Bvh& bvh, state::RegionScratch& scratch) {
  math::Aabb box;
  const float r = static_cast<float>(reach);
  box.include(blast.ground_zero - Vec3{r, r, r});
  box.include(blast.ground_zero + Vec3{r, r, r});
  std::vector<std::uint32_t> vertices;
  state::vertices_near(surface, bvh, box, scratch, vertices);
  std::vector<Target> found;
  for (const std::uint32_t v : vertices) {
    const Vec3 p = surface.position[v];
    const Target t = seen(blast, v, surface);
    // What lies behind a rigid face is shielded.
    if (t.radius <= reach && !state::rigid_between(surface, p.x, p.y, blast.ground_zero.z, p.z, scratch))
      found.push_back(t);
  }
  return found;
}

Target seen(const state::Blast& blast, std::uint32_t vertex, const state::Surface& surface) {
  const Vec3 offset = surface.position[vertex] - blast.ground_zero;
  const double above = -dot(offset, blast.direction);
  const double radius = std::sqrt(std::max(0.0, static_cast<double>(dot(offset, offset)) - above * above));
  return {vertex, radius, above, offset.x, offset.y};
}

Vec3 into_ground(const state::Surface& surface, const std::vector<Target>& reached) {
  Vec3 sum;
  for (const Target& t : reached) sum += state::vertex_normal(surface, t.vertex);
  const Vec3 mean = normalized(sum);
  return mean.z > 0 ? -mean : Vec3{0, 0, -1};
}

}  // namespace divot::events
