#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "laws/blast.h"
#include "laws/crater.h"
#include "refine/edges.h"
#include "world/state.h"

namespace divot {
namespace {

// Where the paper's model leaves a crater, of which it only says the width, it is about as deep as measured ones.
constexpr double kPaperDepth = 0.2;  // of the width

// The crater with the finest curvature of any soil of the terrain; radius 0: none.
laws::CraterSize crater_of(const World::Impl& w, double yield, double height) {
  if (w.scene.solver.blast == Blast::paper) {
    const double width = laws::crater_width(yield);
    return {width / 2, kPaperDepth * width, 0};
  }
  laws::CraterSize largest;
  for (const laws::Medium& medium : w.media) {
    const auto size = laws::scaled_crater(yield, height, medium, length(w.scene.gravity));
    if (size.radius > largest.radius) largest = size;
  }
  return largest;
}

// A bomb's crater as the stage refines it; radius 0: it leaves none.
refine::Zone zone_of(const World::Impl& w, const Bomb& bomb) {
  const Vec3d burst = bomb.position - w.surface.origin;
  const state::SurfacePoint ground = state::surface_at(w.surface, w.tree.bvh, to_float(burst), w.region_scratch);
  if (!ground.found) return {};
  const laws::CraterSize size = crater_of(w, bomb.yield, burst.z - ground.position.z);
  if (!(size.radius > 0) || !(size.depth > 0)) return {};
  return {ground.position, size.radius, refine::crater_edge(size.radius, size.depth, w.scene.terrain.refine.curvature)};
}

// Mass that each body carries, kg: joints share it out among all that they hold together.
std::vector<double> carried_mass(const World::Impl& w) {
  std::vector<std::uint32_t> group(w.bodies.size());
  std::iota(group.begin(), group.end(), 0u);
  for (const state::HeldJoint& joint : w.joints) {
    if (joint.first == kNone) continue;
    const std::uint32_t a = group[joint.first], b = group[joint.second];
    std::replace(group.begin(), group.end(), std::max(a, b), std::min(a, b));
  }
  std::vector<double> mass(w.bodies.size()), count(w.bodies.size()), share(w.bodies.size());
  for (std::size_t i = 0; i < group.size(); ++i) mass[group[i]] += w.bodies[i].mass, count[group[i]] += 1;
  for (std::size_t i = 0; i < group.size(); ++i) share[i] = mass[group[i]] / count[group[i]];
  return share;
}

// The edge that shows where a body touches, m.
double wanted_edge(const World::Impl& w, const state::Body& body, double mass) {
  const auto x = static_cast<float>(body.position.x), y = static_cast<float>(body.position.y);
  const state::SurfacePoint below = state::surface_at(w.surface, w.tree.bvh, x, y, w.region_scratch);
  const laws::Medium& medium = w.media[below.found ? w.surface.material[below.vertex] : 0];
  const Refinement& refine = w.scene.terrain.refine;
  return refine::contact_edge(*body.solid, body.orientation, mass * length(w.scene.gravity), medium,
                              {refine.tolerance, refine.error});
}

// The next one below of those that halving gives, from the terrain's to the scene's finest, m.
double halved_edge(const refine::Limits& limits, double wanted) {
  double edge = limits.base;
  while (edge > wanted * (1 + 1e-6) && edge > limits.edge * (1 + 1e-6)) edge *= 0.5;
  return edge;
}

}  // namespace

void World::Impl::plan_refinement() {
  const Refinement& wanted = scene.terrain.refine;
  if (!(wanted.min_edge > 0)) return;
  double finest = std::numeric_limits<double>::infinity();
  const std::vector<double> mass = carried_mass(*this);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    finest = std::min(finest, bodies[i].edge = wanted_edge(*this, bodies[i], mass[i]));
  for (const Bomb& bomb : scene.bombs) {
    const laws::CraterSize size = crater_of(*this, bomb.yield, 0);
    if (size.radius > 0 && size.depth > 0)
      finest = std::min(finest, refine::crater_edge(size.radius, size.depth, wanted.curvature));
  }
  // Nothing is known of what will come: as fine as may be.
  if (!std::isfinite(finest)) finest = wanted.min_edge;
  const double base = surface.spacing;
  int level = std::clamp(static_cast<int>(std::ceil(std::log2(base / finest) - 1e-6)), 0, wanted.max_level);
  while (level > 0 && std::ldexp(base, -level) < wanted.min_edge * (1 - 1e-6)) --level;
  if (level == 0) return;
  surface.bisection.start(surface.mesh);
  refine_limits = {.edge = std::ldexp(base, -level),
                   .base = base,
                   .tolerance = static_cast<float>(wanted.tolerance),
                   .budget = static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted.budget, kNone / 8))};
  surface.spacing = static_cast<float>(refine_limits.edge);
  for (state::Body& body : bodies) body.edge = halved_edge(refine_limits, body.edge);
  reserve_budget();
}

void World::Impl::plan_refinement(state::Body& body) const {
  body.spacing = surface.spacing;
  if (surface.bisection.started()) body.edge = halved_edge(refine_limits, wanted_edge(*this, body, body.mass));
}

void World::Impl::reserve_budget() {
  if (!surface.bisection.started()) return;
  const std::size_t most = std::size_t{surface.bisection.base_vertex_count()} + refine_limits.budget;
  surface.mesh.reserve(most, std::size_t{surface.bisection.base_face_count()} + 2 * std::size_t{refine_limits.budget});
  surface.position.reserve(most), surface.material.reserve(most), surface.column.reserve(most);
  if (surface.rigid.any())
    triangles.reserve(surface.rigid.triangles.size() + surface.mesh.triangles().size() +
                      6 * std::size_t{refine_limits.budget});
}

void World::Impl::list_triangles() {
  if (!surface.rigid.any()) return;
  const auto ground = surface.mesh.triangles();
  triangles.assign(surface.rigid.triangles.begin(), surface.rigid.triangles.end());
  triangles.insert(triangles.end(), ground.begin(), ground.end());
}

void World::Impl::mark_dirty(std::uint32_t vertex) {
  if (vertex / kDirtyChunk >= dirty_chunk.size()) dirty_chunk.resize(vertex / kDirtyChunk + 1, false);
  dirty_chunk[vertex / kDirtyChunk] = true;
}

bool World::Impl::refine_ground(StepReport& report) {
  if (!surface.bisection.started()) return false;
  return timed(Stage::refine, [&] {
    std::vector<refine::Zone> zones;
    for (const PlannedBomb& planned : bombs) {
      if (!is_due(planned)) continue;
      if (const refine::Zone zone = zone_of(*this, planned.bomb); zone.radius > 0) zones.push_back(zone);
    }
    std::vector<std::uint32_t>& touched = refine_scratch.touched;
    touched.clear();
    refine::Ground ground{surface, soil, particles, blasts, media, material_at, touched};
    // What is about to be pushed is named by its vertices.
    const bool may_join = kicks.empty();
    const refine::Outcome outcome =
        refine::update(ground, tree.bvh, bodies, zones, refine_limits, {scene.dt, length(scene.gravity)}, may_join,
                       refine_progress, refine_scratch);
    for (const std::uint32_t vertex : touched) mark_dirty(vertex), retriangulated.insert(vertex);
    if (!touched.empty()) list_triangles();
    report.refinement_limited = outcome.out_of_budget;
    return outcome.rows;
  });
}

}  // namespace divot
