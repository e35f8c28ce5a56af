#include "contact/gather.h"

#include <algorithm>
#include <cmath>

#include "contact/near.h"
#include "laws/bekker.h"

namespace divot::contact {
namespace {

double fresh_height(const Situation& s, std::uint32_t vertex) {
  const std::uint32_t column = s.surface.column[vertex];
  return column == kNone ? s.surface.position[vertex].z : s.soil.fresh_height(column);
}

// Unit normal, upward, of the ground at a vertex as it would be unpressed.
Vec3d fresh_normal(const Situation& s, std::uint32_t vertex) {
  const auto at = [&](std::uint32_t v) {
    const Vec3 p = s.surface.position[v];
    return Vec3d{p.x, p.y, fresh_height(s, v)};
  };
  const Vec3d p = at(vertex);
  Vec3d sum;
  s.surface.mesh.for_each_outgoing(vertex, [&](std::uint32_t h) {
    sum += cross(at(s.surface.mesh.target(h)) - p, at(s.surface.mesh.origin(geometry::HalfEdgeMesh::prev(h))) - p);
  });
  const double l = length(sum);
  return l > 0 && sum.z > 0 ? sum * (1 / l) : Vec3d{0, 0, 1};
}

Footing footing_at(std::uint32_t vertex, const Situation& s) {
  const Vec3 p = s.surface.position[vertex];
  Footing f{.vertex = vertex, .material = s.surface.material[vertex], .x = p.x, .y = p.y, .vertex_position = p};
  f.height = f.fresh = f.original = p.z;
  const std::uint32_t column = s.surface.column[vertex];
  if (column == kNone) {
    f.area = state::vertex_area(s.surface, vertex);
  } else {
    f.height = std::max(p.z, s.soil.rest[column].z);
    f.fresh = s.soil.fresh_height(column);
    f.original = s.soil.original[column].z;
    f.plastic = s.soil.plastic[column];
    f.area = s.soil.area[column];
    f.shear = to_double(s.soil.shear[column]);
    const std::uint32_t i = s.soil.particle[column];
    f.carried = i != kNone && s.particles.hold[i] == Hold::carried;
    if (i != kNone) f.speed = s.particles.vz[i];
    if (f.carried) f.pull = s.particles.held_pull[i];
  }
  f.mass = s.media[f.material].areal_mass * f.area;
  return f;
}

const Press* find_press(const std::vector<Press>& last, std::uint32_t vertex) {
  const auto at =
      std::lower_bound(last.begin(), last.end(), vertex, [](const Press& p, std::uint32_t v) { return p.vertex < v; });
  return at != last.end() && at->vertex == vertex ? &*at : nullptr;
}

// Vertices sample the ground too coarsely for a hard ball on hard ground: it would drop between them. The column
// nearest to the point where the ball touches the slope is therefore met at that point instead of at its vertex.
void meet_at_lowest_point(const state::Body& body, const Situation& s, std::vector<Footing>& footings) {
  const Vec3d end = body.position + s.dt * body.velocity;
  const auto nearest_to = [&](double x, double y) {
    return std::min_element(footings.begin(), footings.end(), [&](const Footing& a, const Footing& b) {
      return std::hypot(a.x - x, a.y - y) < std::hypot(b.x - x, b.y - y);
    });
  };
  const auto below = nearest_to(end.x, end.y);
  if (below == footings.end()) return;
  const Vec3d slope = fresh_normal(s, below->vertex);
  const double x = end.x - body.radius * slope.x, y = end.y - body.radius * slope.y;
  const auto touched = nearest_to(x, y);
  const double half = 0.5 * s.surface.spacing;
  if (std::abs(touched->x - x) > half || std::abs(touched->y - y) > half) return;
  const Vec3d normal = fresh_normal(s, touched->vertex);
  touched->above_vertex = -(normal.x * (x - touched->x) + normal.y * (y - touched->y)) / normal.z;
  touched->x = x, touched->y = y;
  for (double* height : {&touched->height, &touched->fresh, &touched->original}) *height += touched->above_vertex;
}

// Ground that stands deeper than the pressure of the last step explains must not throw the body out. Where this body
// pressed it, the rest is slack; where nothing did (a body born in the ground, a lip that rose under one), it counts as
// pressed for good.
void take_up_slack(const state::Body& body, const Situation& s, const std::vector<Press>& last, Footing& f) {
  const Underside under = underside(body, body.position, f.x, f.y);
  if (!under.below || under.height >= f.height) return;
  const double sunk = f.fresh - under.height;
  if (f.carried) {
    const Press* press = find_press(last, f.vertex);
    const double elastic = (press ? press->pressure : 0.0) / s.media[f.material].elastic_stiffness;
    f.slack = std::max(0.0, sunk - f.plastic - elastic);
    f.fresh -= f.slack;
  } else {
    f.plastic = std::max(f.plastic, sunk);
  }
}

}  // namespace

void gather(const state::Body& body, const Situation& s, const std::vector<Press>& last,
            std::vector<Footing>& footings) {
  footings.clear();
  const double reach = step_reach(body, s);
  for (const std::uint32_t vertex : body.near)
    if (within_reach(body, s.surface.position[vertex], reach)) footings.push_back(footing_at(vertex, s));
  meet_at_lowest_point(body, s, footings);
  for (Footing& f : footings) take_up_slack(body, s, last, f);
}

}  // namespace divot::contact
