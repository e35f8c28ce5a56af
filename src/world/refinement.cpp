#include <algorithm>
#include <cmath>
#include <limits>

#include "laws/blast.h"
#include "laws/crater.h"
#include "world/place.h"
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
  return {ground.position, static_cast<float>(size.radius),
          refine::crater_edge(size.radius, size.depth, w.scene.terrain.refine.curvature)};
}

// Keeps a list of ids below `count` from growing beyond them.
void drop_repeats(std::vector<std::uint32_t>& ids, std::size_t count) {
  if (ids.size() < 2 * count) return;
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace

void World::Impl::plan_refinement() {
  const Refinement& wanted = scene.terrain.refine;
  if (!(wanted.min_edge > 0)) return;
  double finest = std::numeric_limits<double>::infinity();
  for (const BodySettings& body : scene.bodies)
    if (const auto placed = place::prepare(*this, body); placed)  // what is wrong with it, spawn() will say
      finest = std::min<double>(finest, refine::contact_edge(*placed->solid));
  for (const Bomb& bomb : scene.bombs) {
    const laws::CraterSize size = crater_of(*this, bomb.yield, 0);
    if (size.radius > 0 && size.depth > 0)
      finest = std::min<double>(finest, refine::crater_edge(size.radius, size.depth, wanted.curvature));
  }
  // Nothing is known of what will come: as fine as may be.
  if (!std::isfinite(finest)) finest = wanted.min_edge;
  const double base = surface.spacing;
  int level = std::clamp(static_cast<int>(std::ceil(std::log2(base / finest) - 1e-6)), 0, wanted.max_level);
  while (level > 0 && std::ldexp(base, -level) < wanted.min_edge * (1 - 1e-6)) --level;
  if (level == 0) return;
  surface.spacing = static_cast<float>(std::ldexp(base, -level));
  surface.bisection.start(surface.mesh);
  refine_limits = {.edge = surface.spacing,
                   .tolerance = static_cast<float>(wanted.tolerance),
                   .budget = static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted.budget, kNone / 8))};
  reserve_budget();
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
    const std::size_t known = retriangulated.size();
    refine::Ground ground{surface, soil, particles, blasts, media, material_at, retriangulated};
    // What is about to be pushed is named by its vertices.
    const bool may_join = kicks.empty();
    const refine::Outcome outcome =
        refine::update(ground, tree.bvh, bodies, zones, refine_limits, {scene.dt, length(scene.gravity)}, may_join,
                       refine_progress, refine_scratch);
    for (std::size_t k = known; k < retriangulated.size(); ++k) mark_dirty(retriangulated[k]);
    if (retriangulated.size() > known) list_triangles();
    // Nobody may ever ask for them.
    drop_repeats(retriangulated, surface.position.size());
    drop_repeats(surface.bisection.changed(), surface.mesh.face_count());
    report.refinement_limited = outcome.out_of_budget;
    return outcome.rows;
  });
}

}  // namespace divot
