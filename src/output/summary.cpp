#include "output/summary.h"

#include <fmt/format.h>

#include "output/heading.h"

namespace divot::output {
namespace {

using Json = nlohmann::ordered_json;

Json array(const Vec3d& v) { return Json::array({v.x, v.y, v.z}); }

// Bodies count up in order of creation, so the scene's come first; what was spawned later has no velocity on record.
Json bodies(const World& world) {
  const std::vector<BodyView> views = world.bodies();
  const std::vector<BodySettings>& settings = world.scene().bodies;
  Json out = Json::array();
  for (std::size_t k = 0; k < views.size(); ++k) {
    const Vec3d start = k < settings.size() ? settings[k].velocity : Vec3d{};
    out.push_back({{"name", views[k].name},
                   {"position", array(views[k].position)},
                   {"velocity", array(views[k].velocity)},
                   {"heading_change_deg", heading_change_deg(start, views[k].velocity)},
                   {"max_sinkage_m", views[k].max_sinkage}});
  }
  return out;
}

Json craters(const World& world) {
  Json out = Json::array();
  for (const Crater& c : world.craters()) {
    out.push_back({{"x", c.position.x},
                   {"y", c.position.y},
                   {"yield_t", c.yield},
                   {"width_m", c.width},
                   {"depth_m", c.depth},
                   {"lip_height_m", c.lip_height},
                   {"volume_m3", c.volume},
                   {"lip_volume_m3", c.lip_volume},
                   {"paper_width_m", c.paper_width}});
  }
  return out;
}

Json stages(const World& world) {
  Json out = Json::object();
  for (const StageTime& stage : world.stages()) out[stage.name] = {{"ms", stage.ms}, {"calls", stage.calls}};
  return out;
}

Json updates(const UpdateCounts& counts) {
  return {{"neighbour_rebuilds", counts.neighbour_rebuilds},
          {"bvh_refits", counts.bvh_refits},
          {"bvh_rebuilds", counts.bvh_rebuilds},
          {"missed_pairs", counts.missed_pairs}};
}

Json refinement(const RefinementCounts& counts) {
  return {{"edge_m", counts.edge},
          {"vertices", counts.vertices},
          {"most_vertices", counts.most},
          {"budget", counts.budget},
          {"halved", counts.halved},
          {"joined", counts.joined},
          {"short_steps", counts.short_steps}};
}

Json volume(const SoilVolume& soil) {
  return {{"displaced_m3", soil.displaced},
          {"compacted_m3", soil.compacted},
          {"deposited_m3", soil.deposited},
          {"relative_error", soil.relative_error()}};
}

// Without those that went with their triangles, whose ids wait for new ones.
std::size_t vertex_count(const World& world) {
  const RefinementCounts counts = world.refinement();
  return counts.on ? counts.base_vertices + counts.vertices : world.surface().positions.size();
}

}  // namespace

Json summary(const World& world, const RunTotals& totals) {
  const SurfaceView surface = world.surface();
  Json all = {{"scene", world.scene().name},
              {"simulated_s", world.time()},
              {"steps", world.steps()},
              {"wall_s", totals.wall_s},
              {"real_time_factor", totals.wall_s > 0 ? world.time() / totals.wall_s : 0.0},
              {"interrupted", totals.interrupted},
              {"terrain", {{"vertices", vertex_count(world)}, {"triangles", surface.triangles.size() / 3}}},
              {"particles", {{"peak", world.peak_particles()}, {"final", world.particles().vertices.size()}}},
              {"bodies", bodies(world)},
              {"craters", craters(world)},
              {"stages", stages(world)},
              {"updates", updates(world.updates())},
              {"volume", volume(world.soil_volume())},
              {"flags", {{"substeps_limited", totals.substeps_limited}, {"not_finite", totals.not_finite}}},
              {"state_hash", fmt::format("{:016x}", world.state_hash())}};
  if (world.refinement().on) all["refinement"] = refinement(world.refinement());
  return all;
}

}  // namespace divot::output
