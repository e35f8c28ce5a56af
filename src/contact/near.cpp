#include "contact/near.h"

#include <algorithm>
#include <cmath>

namespace divot::contact {
namespace {

double horizontal_distance_squared(const state::Body& body, const Vec3& p) {
  const double dx = p.x - body.position.x, dy = p.y - body.position.y;
  return dx * dx + dy * dy;
}

// From `start` over the half-edges to the vertex that no neighbour beats in nearness to the body's axis.
std::uint32_t walk(const state::Body& body, const state::Surface& surface, std::uint32_t start) {
  std::uint32_t at = start;
  for (bool moved = true; moved;) {
    moved = false;
    double best = horizontal_distance_squared(body, surface.position[at]);
    const std::uint32_t here = at;
    surface.mesh.for_each_neighbour(here, [&](std::uint32_t u) {
      const double d = horizontal_distance_squared(body, surface.position[u]);
      if (d < best) best = d, at = u, moved = true;
    });
  }
  return at;
}

// Every vertex within `reach` of the body's shadow that hangs together with `start` there, in no order. Bound by the
// walk round each vertex: about 25 ns, of which the set takes a few.
void flood(const state::Surface& surface, std::uint32_t start, double reach, Scratch::PerBody& scratch) {
  std::vector<std::uint32_t>& found = scratch.found;
  scratch.met.clear();
  scratch.met.insert(start);
  found.assign(1, start);
  for (std::size_t k = 0; k < found.size(); ++k)
    surface.mesh.for_each_neighbour(found[k], [&](std::uint32_t u) {
      const Vec3 p = surface.position[u];
      if (scratch.start.over(p.x, p.y, reach) && scratch.met.insert(u)) found.push_back(u);
    });
}

// A walk can be trusted where it ended under the body and the ground there hangs together: no hole or border cuts the
// shadow.
bool shadow_is_whole(const state::Surface& surface, const std::vector<std::uint32_t>& found) {
  return std::none_of(found.begin(), found.end(), [&](std::uint32_t v) { return surface.mesh.is_boundary(v); });
}

// Ground over the body that it is not in: that on a bridge, seen from below.
bool is_behind_rigid(const state::Body& body, const Situation& s, std::uint32_t v, state::RegionScratch& region) {
  const Vec3 p = s.surface.position[v];
  const float z = static_cast<float>(body.position.z);
  return p.z > z && state::rigid_between(s.surface, p.x, p.y, z, p.z, region);
}

}  // namespace

double step_travel(const state::Body& body, const Situation& s) {
  const double speed =
      length(body.velocity) + geometry::sweep_speed(*body.solid, body.orientation, body.angular_velocity);
  return speed * s.dt + length(s.gravity) * s.dt * s.dt;
}

double step_reach(const state::Body& body, const Situation& s) { return step_travel(body, s) + 0.5 * body.spacing; }

void find_near(state::Body& body, const Situation& s, Scratch::PerBody& scratch) {
  const bool adaptive = s.policy.kind == UpdatePolicy::Kind::adaptive;
  const double needed = step_reach(body, s);
  if (adaptive && body.near_left > needed) return;

  // With the adaptive policy what is found now serves for a few steps more.
  const double reach = needed + (adaptive ? std::max(0.5 * body.spacing, 4 * step_travel(body, s)) : s.ground_moved);
  bool walked = false;
  if (adaptive && body.last_vertex != kNone) {
    const std::uint32_t below = walk(body, s.surface, body.last_vertex);
    const Vec3 p = s.surface.position[below];
    if (scratch.start.over(p.x, p.y, reach)) {
      flood(s.surface, below, reach, scratch);
      walked = shadow_is_whole(s.surface, scratch.found);
    }
  }
  if (!walked) {
    // Floats may round inward.
    const double more = reach + 1e-5 * (body.radius + reach);
    const Vec3 low = to_float(scratch.start.low() - Vec3d{more, more, more});
    const Vec3 high = to_float(scratch.start.high() + Vec3d{more, more, more});
    math::Aabb column;
    column.include(low);
    column.include(Vec3{high.x, high.y, math::Aabb::kInf});
    scratch.region.faces.clear(), scratch.found.clear();
    state::faces_near(s.surface, s.bvh, column, scratch.region.faces);
    for (const std::uint32_t face : scratch.region.faces)
      for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h) scratch.found.push_back(s.surface.mesh.origin(h));
  }
  body.near.clear();
  for (const std::uint32_t v : scratch.found)
    if (scratch.start.within_reach(s.surface.position[v], reach) && !is_behind_rigid(body, s, v, scratch.region))
      body.near.push_back(v);
  std::sort(body.near.begin(), body.near.end());
  body.near.erase(std::unique(body.near.begin(), body.near.end()), body.near.end());
  body.near_left = reach;
}

}  // namespace divot::contact
