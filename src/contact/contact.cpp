#include "contact/contact.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "contact/gather.h"
#include "contact/near.h"
#include "contact/soil_reaction.h"

namespace divot::contact {
namespace {

// The surface may follow a body sideways by this share of the spacing in all, so that its triangles keep their shape.
constexpr float kMostDrag = 0.1f;

void meet_ground(state::Body& body, const Situation& s, Scratch::PerBody& scratch) {
  body.near_left -= s.ground_moved;
  find_near(body, s, scratch);
  gather(body, s, scratch.presses, scratch.footings);
  meet_soil(body, scratch.footings, s, scratch.contacts);
}

bool pressed_before(const std::vector<Press>& last, std::uint32_t vertex) {
  const auto at =
      std::lower_bound(last.begin(), last.end(), vertex, [](const Press& p, std::uint32_t v) { return p.vertex < v; });
  return at != last.end() && at->vertex == vertex;
}

void wake_pressed(const Scratch::PerBody& scratch, const state::Surface& surface, std::vector<std::uint32_t>& wake) {
  for (const Press& press : scratch.presses) {
    wake.push_back(press.vertex);
    if (!pressed_before(scratch.last, press.vertex))
      surface.mesh.for_each_neighbour(press.vertex, [&](std::uint32_t u) { wake.push_back(u); });
  }
}

void release(const Scratch::PerBody& scratch, state::Particles& p, state::Soil& soil, const state::Surface& surface) {
  for (const Press& press : scratch.last) {
    const std::uint32_t column = surface.column[press.vertex], i = soil.particle[column];
    if (i == kNone || p.hold[i] != Hold::carried) continue;
    p.hold[i] = Hold::free;
    p.set_velocity(i, {});
    if (!pressed_before(scratch.presses, press.vertex)) soil.shear[column] = {};
  }
}

Vec3 keep_shape(Vec3 place, const Vec3& original, float spacing) {
  const float dx = place.x - original.x, dy = place.y - original.y, drag = std::sqrt(dx * dx + dy * dy);
  const float most = kMostDrag * spacing;
  if (drag > most) place.x = original.x + dx * most / drag, place.y = original.y + dy * most / drag;
  return place;
}

void press(const Press& press, state::Particles& p, state::Soil& soil, const state::Surface& surface, float dt) {
  const std::uint32_t column = surface.column[press.vertex], i = soil.particle[column];
  const float fresh = soil.fresh_height(column);
  const Vec3 place = keep_shape(press.position, soil.original[column], surface.spacing);
  // Where two bodies press one vertex, the deeper one carries it.
  const bool shared = p.hold[i] == Hold::carried;
  if (!shared || place.z < p.z[i] + dt * p.vz[i]) p.set_velocity(i, (1 / dt) * (place - p.position(i)));
  p.hold[i] = Hold::carried;
  p.flow_rate[i] = 0;
  p.still_steps[i] = 0;
  soil.shear[column] = press.shear;
  soil.plastic[column] = std::max(soil.plastic[column], press.plastic);
  soil.rest[column] = {place.x, place.y, fresh - soil.plastic[column]};
}

}  // namespace

void move_bodies(std::span<state::Body> bodies, RigidBodies& rigid, const Situation& s,
                 std::vector<std::uint32_t>& wake, Scratch& scratch, const Jobs& jobs) {
  scratch.bodies.resize(bodies.size());
  const auto meet = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) meet_ground(bodies[i], s, scratch.bodies[i]);
  };
  jobs.for_ranges(bodies.size(), 4, std::ref(meet));  // by reference: a copy would be an allocation
  std::vector<Vec3d>& before = scratch.before;
  before.clear();
  for (const state::Body& body : bodies) before.push_back(body.position);
  rigid.advance(bodies, s.dt);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Scratch::PerBody& own = scratch.bodies[i];
    std::swap(own.last, own.presses);
    record_presses(bodies[i], own.footings, own.contacts, own.presses);
    bodies[i].near_left -= length(bodies[i].position - before[i]);
    wake_pressed(own, s.surface, wake);
  }
}

void carry(std::span<state::Body> bodies, state::Particles& particles, state::Soil& soil, const state::Surface& surface,
           double dt, const Scratch& scratch) {
  for (std::size_t i = 0; i < bodies.size(); ++i) release(scratch.bodies[i], particles, soil, surface);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (const Press& one : scratch.bodies[i].presses) press(one, particles, soil, surface, static_cast<float>(dt));
}

}  // namespace divot::contact
