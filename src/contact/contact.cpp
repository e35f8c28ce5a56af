#include "contact/contact.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "contact/gather.h"
#include "contact/near.h"
#include "contact/soil_reaction.h"

namespace divot::contact {
namespace {

// The surface may follow a body sideways by this share of the spacing in all, so that its triangles keep their shape.
constexpr float kMostDrag = 0.1f;

void meet_ground(state::Body& body, const Situation& s, Scratch::PerBody& scratch, Resistance& resistance) {
  body.near_left -= s.ground_moved;
  scratch.start.place(*body.solid, body.position, body.orientation);
  find_near(body, s, scratch);
  gather(body, s, scratch);
  meet_soil(body, s, scratch, resistance);
}

// Of what joints and other bodies gave, the next step counts on what lasts: a blow is not expected again.
void expect(state::Body& body, const std::optional<Row>& impulse) {
  const auto size = [&](const Row& p) { return length(math::linear(p)) + length(math::angular(p)) / body.radius; };
  const Row now = impulse.value_or(Row{});
  body.held_impulse = size(now) > 2 * size(body.last_impulse) ? body.last_impulse : now;
  body.last_impulse = now;
}

// The body is where the step has brought it.
void leave_ground(state::Body& body, const std::optional<Row>& impulse, const Scratch::Pose& before, const Situation& s,
                  Scratch::PerBody& scratch) {
  if (impulse) answer_again(body, before, s, scratch);
  expect(body, impulse);
  body.velocity += math::linear(scratch.gain), body.angular_velocity += math::angular(scratch.gain);
  std::swap(scratch.last, scratch.presses);
  record_presses(body, scratch);
  const double sweep = geometry::sweep_speed(*body.solid, body.orientation, body.angular_velocity);
  body.near_left -= length(body.position - before.position) + sweep * s.dt;
}

// Calls f(press, before) for each of `presses`: whether its vertex is among `others` too. Both ascend.
template <class F>
void for_each_press(const std::vector<Press>& presses, const std::vector<Press>& others, F f) {
  auto other = others.begin();
  for (const Press& press : presses) {
    while (other != others.end() && other->vertex < press.vertex) ++other;
    f(press, other != others.end() && other->vertex == press.vertex);
  }
}

// A body that wakes something wakes so many rings of vertices round all that it presses: what depends on the set of
// particles is dear to make anew, and a body that rolls would change the set in every step.
constexpr std::size_t kWokenRings = 3;

bool is_awake(const Situation& s, std::uint32_t vertex) {
  const std::uint32_t column = s.surface.column[vertex], i = column == kNone ? kNone : s.soil.particle[column];
  return i != kNone && (s.particles.hold[i] == Hold::free || s.particles.hold[i] == Hold::carried);
}

// What is pressed has to be awake, and what lies next to where it was not pressed before.
bool must_wake(const Scratch::PerBody& scratch, const Situation& s) {
  bool awake = true;
  for_each_press(scratch.presses, scratch.last, [&](const Press& press, bool before) {
    awake = awake && is_awake(s, press.vertex);
    if (awake && !before)
      s.surface.mesh.for_each_neighbour(press.vertex, [&](std::uint32_t u) { awake = awake && is_awake(s, u); });
  });
  return !awake;
}

void wake_pressed(Scratch::PerBody& scratch, const Situation& s, std::vector<std::uint32_t>& wake) {
  if (!must_wake(scratch, s)) return;
  std::vector<std::uint32_t>& reached = scratch.found;
  reached.clear(), scratch.met.clear();
  for (const Press& press : scratch.presses) reached.push_back(press.vertex), scratch.met.insert(press.vertex);
  for (std::size_t ring = 0, begin = 0; ring < kWokenRings; ++ring) {
    const std::size_t end = reached.size();
    for (; begin < end; ++begin)
      s.surface.mesh.for_each_neighbour(reached[begin], [&](std::uint32_t u) {
        if (scratch.met.insert(u)) reached.push_back(u);
      });
  }
  wake.insert(wake.end(), reached.begin(), reached.end());
}

void release(const Scratch::PerBody& scratch, state::Particles& p, state::Soil& soil, const state::Surface& surface) {
  for_each_press(scratch.last, scratch.presses, [&](const Press& press, bool still) {
    const std::uint32_t column = surface.column[press.vertex], i = soil.particle[column];
    if (i == kNone || p.hold[i] != Hold::carried) return;
    p.hold[i] = Hold::free;
    p.carrier[i] = kNone;
    p.yielded[i] = 0;
    p.set_velocity(i, {});
    if (!still) soil.shear[column] = {};
  });
}

Vec3 keep_shape(Vec3 place, const Vec3& original, float spacing) {
  const float dx = place.x - original.x, dy = place.y - original.y, drag = std::sqrt(dx * dx + dy * dy);
  const float most = kMostDrag * spacing;
  if (drag > most) place.x = original.x + dx * most / drag, place.y = original.y + dy * most / drag;
  return place;
}

void press(const Press& press, std::uint32_t body, state::Particles& p, state::Soil& soil,
           const state::Surface& surface, float dt) {
  const std::uint32_t column = surface.column[press.vertex], i = soil.particle[column];
  const float fresh = soil.fresh_height(column);
  const Vec3 place = keep_shape(press.position, soil.original[column], surface.spacing);
  // Where two bodies press one vertex, the deeper one carries it.
  const bool shared = p.hold[i] == Hold::carried;
  if (!shared || place.z < p.z[i] + dt * p.vz[i]) {
    p.set_velocity(i, (1 / dt) * (place - p.position(i)));
    p.carrier[i] = body;
  }
  p.hold[i] = Hold::carried;
  p.flow_rate[i] = 0;
  p.still_steps[i] = 0;
  soil.shear[column] = press.shear;
  const float yields = std::max(0.0f, press.plastic - soil.plastic[column]);
  p.yielded[i] = shared ? p.yielded[i] + yields : yields;
  soil.plastic[column] += yields;
  soil.rest[column] = {place.x, place.y, fresh - soil.plastic[column]};
}

}  // namespace

void move_bodies(std::span<state::Body> bodies, std::span<state::HeldJoint> joints, RigidBodies& rigid,
                 const Situation& s, std::vector<std::uint32_t>& wake, Scratch& scratch, const Jobs& jobs) {
  scratch.bodies.resize(bodies.size()), scratch.resistance.resize(bodies.size());
  scratch.rows.clear(), scratch.first_row.assign(1, 0), scratch.before.clear();
  for (state::HeldJoint& joint : joints) {
    append_rows(joint, bodies, s.time, s.dt, scratch.rows);
    scratch.first_row.push_back(scratch.rows.size());
  }
  // Guides look at the other bodies' velocities, which the soil's answer then changes.
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    find_guides(i, scratch.rows, bodies, scratch.bodies[i].guides);
    scratch.before.push_back({bodies[i].position, bodies[i].orientation});
  }
  const auto meet = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) meet_ground(bodies[i], s, scratch.bodies[i], scratch.resistance[i]);
  };
  jobs.for_ranges(bodies.size(), 4, std::ref(meet));  // by reference: a copy would be an allocation
  rigid.advance(bodies, scratch.rows, scratch.resistance, s.dt);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const std::size_t first = scratch.first_row[j], last = scratch.first_row[j + 1];
    keep_impulses(joints[j], std::span(scratch.rows).subspan(first, last - first), s.dt);
  }
  const auto leave = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      bodies[i].way = bodies[i].position - scratch.before[i].position;
      leave_ground(bodies[i], rigid.impulse(i), scratch.before[i], s, scratch.bodies[i]);
    }
  };
  jobs.for_ranges(bodies.size(), 4, std::ref(leave));
  for (Scratch::PerBody& own : scratch.bodies) wake_pressed(own, s, wake);
}

void carry(std::span<state::Body> bodies, state::Particles& particles, state::Soil& soil, const state::Surface& surface,
           double dt, const Scratch& scratch) {
  for (std::size_t i = 0; i < bodies.size(); ++i) release(scratch.bodies[i], particles, soil, surface);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (const Press& one : scratch.bodies[i].presses)
      press(one, static_cast<std::uint32_t>(i), particles, soil, surface, static_cast<float>(dt));
}

}  // namespace divot::contact
