#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "world/state.h"

namespace divot {
namespace {

// A particle slower than this share of the spacing a second, or than so many m/s, for this long, is still: it has at
// most two millimetres less of its way. Soil that creeps on as bonds give way would keep a rut's whole length awake.
constexpr double kStillSpeed = 1e-3, kCreep = 1e-2, kStillTime = 0.2;

// Substeps follow the fastest thing in the particle system. Semi-implicit Euler is stable while (frequency h)^2 + 2
// damping h stays below 4, so each times h may be 1.
constexpr int kMostSubsteps = 64;
// Share of a blast's pulse that one substep may take while it is violent.
constexpr double kPulseShare = 0.125;

// What is too fast for the most substeps is softened anyway, and need not be followed at all while none of it moves
// faster than so many spacings a second: a road's edge in the mud.
constexpr double kSlowSpeed = 0.1;

struct Substeps {
  int count = 1;
  bool limited = false;
  laws::Resolution resolution;
};

// The least mass of a particle of each medium that is awake; infinite where there is none.
void find_least_masses(const state::Particles& p, std::size_t media, std::vector<float>& least) {
  least.assign(media, std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.hold[i] != Hold::anchor) least[p.material[i]] = std::min(least[p.material[i]], p.mass[i]);
}

// The higher of frequency and damping rate of a particle of a medium, 1/s; `flow`: the drag of what a blast makes flow.
double rate_of(const laws::Medium& m, float mass, double flow) {
  const double ground = m.ground ? m.elastic_stiffness / m.areal_mass : 0;
  const double frequency = std::sqrt(laws::lattice_stiffness(m) / mass + ground);
  const double drag = m.ground ? m.ground_damping / m.areal_mass : 0;
  return std::max(frequency,
                  laws::kLatticeDamping * m.viscous_damping / mass + m.areal_damping / m.areal_mass + drag + flow);
}

double drag_of_flow(std::span<const state::Blast> blasts) {
  double flow = 0;
  for (const state::Blast& blast : blasts)
    if (blast.active) flow = std::max<double>(flow, blast.flow_rate);
  return flow;
}

// Does no free particle of a medium move faster than `speed`, m/s?
bool is_slow(const state::Particles& p, std::size_t medium, float speed) {
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.material[i] == medium && p.hold[i] == Hold::free && length(p.velocity(i)) > speed) return false;
  return true;
}

// While its pulse lasts, and then for eight relaxation times of what it made flow.
bool is_violent(const state::Blast& blast, double time) {
  return blast.active && time < blast.start + 17 * blast.pulse;
}

// Substeps follow the lightest particle of the fastest medium that is awake.
Substeps plan_substeps(const state::Particles& p, std::span<const float> least_mass, float slow,
                       std::span<const laws::Medium> media, std::span<const state::Blast> blasts, double time,
                       double dt) {
  const double flow = drag_of_flow(blasts);
  double wanted = 0, all = 0;
  for (std::size_t k = 0; k < least_mass.size(); ++k) {
    if (!std::isfinite(least_mass[k])) continue;
    const double own = dt * rate_of(media[k], least_mass[k], flow);
    all = std::max(all, own);
    if (own <= kMostSubsteps || !is_slow(p, k, slow)) wanted = std::max(wanted, own);
  }
  for (const state::Blast& blast : blasts)
    if (is_violent(blast, time)) wanted = std::max(wanted, dt / (kPulseShare * blast.pulse));
  Substeps plan;
  plan.count = std::clamp(static_cast<int>(std::ceil(wanted)), 1, kMostSubsteps);
  plan.limited = std::max(wanted, all) > plan.count;
  plan.resolution.rate = static_cast<float>(plan.limited ? plan.count / dt : 1e18);
  return plan;
}

// Puts to rest, at the last place that was a number, whatever left the numbers.
void rescue(state::Particles& p, const state::Surface& surface) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (is_finite(p.position(i)) && is_finite(p.velocity(i))) continue;
    p.set_position(i, surface.position[p.vertex[i]]);
    p.set_velocity(i, {});
  }
}

bool rescue(state::Body& body, const Vec3d& last) {
  if (is_finite(body.position) && is_finite(body.velocity) && is_finite(body.angular_velocity)) return false;
  body.position = last;
  body.velocity = body.angular_velocity = {};
  return true;
}

// How far of what moved lies furthest sideways from where it started, m.
float furthest_astray(const state::Surface& surface, const state::Soil& soil, const settle::Moved& moved) {
  float squared = 0;
  for (const std::uint32_t vertex : moved.vertices) {
    const std::uint32_t column = surface.column[vertex];
    if (column == kNone) continue;
    const Vec3 way = surface.position[vertex] - soil.original[column];
    squared = std::max(squared, way.x * way.x + way.y * way.y);
  }
  return std::sqrt(squared);
}

}  // namespace

void World::Impl::set_off_bombs() {
  timed(Stage::events, [&] {
    for (const events::Kick& kick : kicks) wake.push_back(kick.vertex);
    for (PlannedBomb& planned : bombs) {
      if (!is_due(planned)) continue;
      planned.exploded = true;
      blasts.push_back(events::detonate(planned.bomb, scene.solver.blast, {time(), scene.dt, length(scene.gravity)},
                                        blasts, surface, soil, tree.bvh, media, region_scratch));
      for (const std::uint32_t column : blasts.back().column) wake.push_back(soil.vertex[column]);
      for (const std::uint32_t column : blasts.back().landing) wake.push_back(soil.vertex[column]);
    }
  });
}

void World::Impl::move_bodies(StepReport& report) {
  if (bodies.empty()) return;
  timed(Stage::contact, [&] {
    const contact::Situation situation{surface,
                                       tree.bvh,
                                       soil,
                                       particles,
                                       media,
                                       scene.gravity,
                                       scene.dt,
                                       moved.free_distance,
                                       scene.solver.bvh_update,
                                       time()};
    contact::move_bodies(bodies, joints, rigid, situation, wake, contact_scratch, *jobs);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      report.not_finite |= rescue(bodies[i], contact_scratch.before[i].position);
      bodies[i].off_terrain = bodies[i].near.empty() && bodies[i].position.z < lowest - 2 * bodies[i].radius;
    }
  });
}

bool World::Impl::wake_and_sleep() {
  return timed(Stage::activation, [&] {
    bool changed = activation::update(particles, soil, surface, media, wake, activation_scratch);
    events::kick(kicks, surface, soil, particles);
    contact::carry(bodies, particles, soil, surface, scene.dt, contact_scratch);
    changed |= break_crusts();
    for (const state::Blast& blast : blasts)
      if (blast.active && blast.start == time()) events::loosen(blast, soil, particles);
    std::size_t awake = 0;
    for (const Hold hold : particles.hold) awake += hold != Hold::anchor;
    peak_particles = std::max(peak_particles, awake);
    return changed;
  });
}

void World::Impl::find_neighbours(bool particles_changed) {
  timed(Stage::neighbours, [&] {
    const neighbours::Reach reach{static_cast<float>(scene.solver.cutoff) * surface.spacing,
                                  static_cast<float>(scene.solver.skin) * surface.spacing, scene.solver.neighbours,
                                  scene.solver.neighbour_update};
    neighbours::update(particles, bonds, neighbours, reach, particles_changed, *jobs);
  });
}

void World::Impl::move_particles(bool particles_changed, StepReport& report) {
  if (particles.size() == 0) return;
  if (particles_changed) find_least_masses(particles, media.size(), least_mass);
  const Substeps plan = plan_substeps(particles, least_mass, static_cast<float>(kSlowSpeed * surface.spacing), media,
                                      blasts, time(), scene.dt);
  report.substeps = plan.count;
  report.substeps_limited = plan.limited;
  const forces::Field field{
      soil,           media, blasts, scene.solver.cohesion, static_cast<float>(scene.solver.cutoff) * surface.spacing,
      plan.resolution};
  forces::Renew renew = forces::Renew::no;
  const auto forces_at = [&](const state::MotionView& motion, double at) {
    timed(Stage::forces, [&] { forces::evaluate(particles, bonds, motion, at, field, renew, forces_scratch, *jobs); });
    renew = forces::Renew::no;
    return integration::ForceView{particles.fx, particles.fy, particles.fz};
  };
  const integration::Forces evaluate = std::ref(forces_at);  // a copy would be an allocation
  state::Particles& p = particles;
  const state::MotionView motion{p.x, p.y, p.z, p.vx, p.vy, p.vz};
  const double h = scene.dt / plan.count;
  for (int k = 0; k < plan.count; ++k) {
    const double at = time() + k * h;
    find_neighbours(particles_changed && k == 0);
    renew = forces::Renew::yes;
    const bool blast_acts = std::any_of(blasts.begin(), blasts.end(), [](const state::Blast& b) { return b.active; });
    const bool rk4 =
        scene.solver.integrator == Integrator::rk4 || (scene.solver.integrator == Integrator::automatic && blast_acts);
    const bool numbers = timed(Stage::integration, [&] {
      return rk4 ? integration::rk4(motion, p.mass, at, h, evaluate, integration_scratch, *jobs)
                 : integration::euler(motion, p.mass, at, h, evaluate, *jobs);
    });
    if (!numbers) {
      rescue(p, surface);
      report.not_finite = true;
    }
    timed(Stage::forces, [&] { forces::yield(p, soil, media, plan.resolution, *jobs); });
  }
}

void World::Impl::settle_ground(bool particles_changed) {
  timed(Stage::settle, [&] {
    const double speed = std::max(kStillSpeed * surface.spacing, kCreep);
    const settle::Stillness stillness{
        static_cast<float>(speed), static_cast<float>(speed * scene.dt),
        static_cast<std::uint16_t>(std::clamp(std::ceil(kStillTime / scene.dt), 2.0, 60000.0))};
    const settle::Step step{time() + scene.dt, scene.dt, -scene.gravity.z};
    settle::update(particles, soil, surface, blasts, bodies, media, stillness, step, particles_changed, moved,
                   settle_scratch, *jobs);
    std::uint32_t last = kNone;
    for (const std::uint32_t vertex : moved.vertices) {
      if (vertex / kDirtyChunk == last) continue;
      last = vertex / kDirtyChunk;
      dirty_chunk[last] = true;
    }
    if (surface.bisection.started()) surface.strayed = std::max(surface.strayed, furthest_astray(surface, soil, moved));
  });
}

void World::Impl::refit_tree() {
  timed(Stage::refit,
        [&] { refit::update(tree, surface, moved.vertices, moved.distance, scene.solver.bvh_update, *jobs); });
}

}  // namespace divot
