#include "contact/gather.h"

#include <algorithm>
#include <cmath>

#include "contact/near.h"

namespace divot::contact {
namespace {

void clear(Ground& g) {
  g.vertex.clear(), g.material.clear(), g.carried.clear(), g.shear.clear();
  for (auto* array : {&g.x, &g.y, &g.height, &g.fresh, &g.original, &g.plastic, &g.area, &g.mass, &g.pull, &g.speed})
    array->clear();
}

void append_untouched(std::uint32_t vertex, const Situation& s, Ground& g) {
  const Vec3 p = s.surface.position[vertex];
  g.height.push_back(p.z), g.fresh.push_back(p.z), g.original.push_back(p.z), g.plastic.push_back(0);
  g.area.push_back(state::vertex_area(s.surface, vertex));
  g.shear.push_back({});
}

void append_touched(std::uint32_t vertex, std::uint32_t column, const Situation& s, Ground& g) {
  const Vec3 p = s.surface.position[vertex];
  g.height.push_back(std::max(p.z, s.soil.rest[column].z));
  g.fresh.push_back(s.soil.fresh_height(column));
  g.original.push_back(s.soil.original[column].z);
  g.plastic.push_back(s.soil.plastic[column]);
  g.area.push_back(s.soil.area[column]);
  g.shear.push_back(to_double(s.soil.shear[column]));
}

}  // namespace

void gather(const state::Body& body, const Situation& s, Ground& g) {
  clear(g);
  const double travel = length(body.velocity) * s.dt + length(s.gravity) * s.dt * s.dt;
  double nearest = math::Aabb::kInf;
  for (const std::uint32_t vertex : body.near) {
    const Vec3 p = s.surface.position[vertex];
    const double dx = p.x - body.position.x, dy = p.y - body.position.y, wide = body.radius + travel;
    const double side = wide * wide - dx * dx - dy * dy;
    if (side < 0 || p.z < body.position.z - std::sqrt(side) - travel) continue;
    const std::uint32_t column = s.surface.column[vertex];
    g.vertex.push_back(vertex);
    g.material.push_back(s.surface.material[vertex]);
    g.x.push_back(p.x), g.y.push_back(p.y);
    const std::uint32_t particle = column != kNone ? s.soil.particle[column] : kNone;
    const bool carried = particle != kNone && s.particles.hold[particle] == state::Hold::carried;
    if (column == kNone)
      append_untouched(vertex, s, g);
    else
      append_touched(vertex, column, s, g);
    g.carried.push_back(carried);
    g.pull.push_back(carried ? s.particles.held_pull[particle] : 0);
    g.speed.push_back(particle != kNone ? s.particles.vz[particle] : 0);
    g.mass.push_back(s.media[g.material.back()].areal_mass * g.area.back());

    // Ground that is already inside the body although nothing pressed it there (a body born in the ground, a crater's lip that
    // rose under one) counts as pressed: it must not throw the body out.
    const std::size_t k = g.vertex.size() - 1;
    const Underside under = underside(body, body.position, g.x[k], g.y[k]);
    if (under.below && !carried && under.height < g.height[k])
      g.plastic[k] = std::max(g.plastic[k], g.fresh[k] - under.height);
    const double gap = under.below ? under.height - p.z : math::Aabb::kInf;
    if (gap < nearest) nearest = gap, g.deepest = k;
  }
  if (nearest == math::Aabb::kInf) g.deepest = 0;
}

}  // namespace divot::contact
