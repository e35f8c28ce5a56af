#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "output/resample.h"
#include "terrain/material_map.h"
#include "terrain/terrain.h"
#include "world/place.h"
#include "world/state.h"

namespace divot {
namespace {

// Every material that the scene's ground is made of, the terrain's own first, and below it what it is a crust over.
std::vector<Material> materials_in_use(const Scene& scene) {
  std::vector<Material> used;
  const auto use = [&](const std::string& name) {
    if (std::ranges::find(used, name, &Material::name) == used.end()) used.push_back(*find_material(scene, name));
  };
  use(scene.terrain.material);
  for (const LegendEntry& entry : scene.terrain.material_map.legend) use(entry.material);
  if (const auto* mesh = std::get_if<MeshTerrain>(&scene.terrain.shape)) {
    for (const std::uint8_t index : mesh->materials) use(scene.materials[index].name);
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i].over.empty()) use(std::string(used[i].over));
  }
  return used;
}

std::vector<laws::Medium> media_of(const std::vector<Material>& materials, double gravity) {
  std::vector<laws::Medium> media;
  for (const Material& material : materials) {
    media.push_back(laws::make_medium(material));
    media.back().weight = static_cast<float>(gravity) * media.back().areal_mass;
    if (material.over.empty()) continue;
    const auto below = std::ranges::find(materials, material.over, &Material::name);
    media.back().below = static_cast<std::uint8_t>(below - materials.begin());
  }
  return media;
}

Result<void> check_rasters(const Scene& scene, const state::Surface& surface) {
  if (!surface.raster) return {};
  const auto [columns, rows] = output::pixels_of(*surface.raster, scene.output.raster_spacing);
  if (scene.output.raster_spacing <= 0 || columns <= scene.terrain.max_vertices / rows) return {};
  return fail({.key = "output.raster_spacing",
               .problem = fmt::format("rasters would have {} x {} pixels, more than the limit of {}", columns, rows,
                                      scene.terrain.max_vertices),
               .expected = "expected a larger spacing or a higher `terrain.max_vertices`"});
}

// Bodies of an assembly keep their places to each other: all are lifted by what the first to touch the ground needs.
std::vector<BodySettings> standing(const World::Impl& w, std::vector<BodySettings> bodies) {
  std::map<std::string, double> height;
  const auto together = [](const BodySettings& body) { return body.above_ground && !body.assembly.empty(); };
  const auto lift_of = [&](const BodySettings& body) -> std::optional<double> {
    const auto made = place::prepare(w, body);
    if (!made) return std::nullopt;  // what is wrong with it, spawn() will say
    return place::lift(w, body, place::placed(w, body, *made));
  };
  for (const BodySettings& body : bodies) {
    if (!together(body)) continue;
    const auto lift = lift_of(body);
    if (!lift) continue;
    const auto [at, fresh] = height.try_emplace(body.assembly, *lift - body.position.z);
    if (!fresh) at->second = std::max(at->second, *lift - body.position.z);
  }
  for (BodySettings& body : bodies) {
    if (!together(body) || !height.contains(body.assembly)) continue;
    body.position.z += height[body.assembly] + w.surface.origin.z;
    body.above_ground = false;
  }
  return bodies;
}

Result<Bomb> place_bomb(const World::Impl& w, Bomb bomb) {
  bomb.position.z -= bomb.depth;
  bomb.depth = 0;
  if (!bomb.above_ground) return bomb;
  const Vec3d local = bomb.position - w.surface.origin;
  const state::SurfacePoint ground = state::surface_at(w.surface, w.tree.bvh, static_cast<float>(local.x),
                                                       static_cast<float>(local.y), w.region_scratch);
  if (!ground.found) return fail(place::no_ground(w, "bombs", bomb.position));
  bomb.position.z += ground.position.z + w.surface.origin.z;
  bomb.above_ground = false;
  return bomb;
}

}  // namespace

Result<World> World::create(const Scene& scene, std::shared_ptr<const Jobs> jobs) {
  if (Errors errors = check(scene); !errors.empty()) return tl::unexpected(std::move(errors));
  auto surface = terrain::load_terrain(scene);
  if (!surface) return tl::unexpected(std::move(surface.error()));
  if (auto ok = check_rasters(scene, *surface); !ok) return tl::unexpected(ok.error());

  auto impl = std::make_unique<Impl>();
  impl->scene = scene;
  impl->jobs = jobs ? std::move(jobs) : std::make_shared<const Jobs>(1);
  impl->materials = materials_in_use(scene);
  if (impl->materials.size() > laws::kNoLayer)
    return fail({.key = "materials",
                 .problem = fmt::format("the ground is made of {} materials", impl->materials.size()),
                 .expected = fmt::format("expected at most {}", laws::kNoLayer)});
  impl->media = media_of(impl->materials, std::max(0.0, -scene.gravity.z));
  if (auto ok = terrain::place_materials(scene, impl->materials, *surface); !ok) return tl::unexpected(ok.error());
  impl->surface = std::move(*surface);
  impl->terrain_fingerprint = terrain::fingerprint(impl->surface);
  impl->lowest = math::Aabb::kInf;
  for (const Vec3& p : impl->surface.position) impl->lowest = std::min<double>(impl->lowest, p.z);
  impl->dirty_chunk.assign(impl->surface.position.size() / kDirtyChunk + 1, false);
  impl->list_triangles();
  if (impl->surface.rigid.any()) impl->rigid.add(impl->surface.rigid, impl->surface.position, impl->media.front());
  impl->tree.margin = kBoxMargin * impl->surface.spacing;
  refit::build(impl->tree, impl->surface, *impl->jobs);

  World world(std::move(impl));
  Errors errors;
  const auto keep_errors = [&](const auto& result) {
    if (!result) errors.insert(errors.end(), result.error().begin(), result.error().end());
  };
  for (const BodySettings& body : standing(*world.impl_, scene.bodies)) keep_errors(world.spawn(body));
  if (errors.empty())
    for (const Joint& joint : scene.joints) keep_errors(world.add_joint(joint));
  for (const Bomb& bomb : scene.bombs) keep_errors(world.add_bomb(bomb));
  if (!errors.empty()) return tl::unexpected(std::move(errors));
  World::Impl& w = *world.impl_;
  w.plan_refinement();
  if (w.surface.bisection.started()) {
    auto material_at = terrain::material_between(scene, w.materials, w.surface);
    if (!material_at) return tl::unexpected(material_at.error());
    w.material_at = std::move(*material_at);
  }
  return world;
}

Result<BodyId> World::spawn(const BodySettings& settings) {
  Scene alone;
  alone.bodies.push_back(settings);
  if (Errors errors = check(alone); !errors.empty()) return tl::unexpected(std::move(errors));
  auto made = place::prepare(*impl_, settings);
  if (!made) return tl::unexpected(made.error());
  state::Body& body = *made;
  place::Placed placed = place::placed(*impl_, settings, body);
  if (settings.above_ground) {
    const auto lift = place::lift(*impl_, settings, placed);
    if (!lift)
      return fail(place::no_ground(*impl_, fmt::format("bodies.{}.position", settings.name), settings.position));
    placed.origin.z = *lift + settings.position.z;
  }
  if (const auto good = place::check_place(*impl_, settings, placed); !good) return tl::unexpected(good.error());

  if (place::is_set_down(*impl_, settings, placed)) body.weight_share = 0;
  using math::operator*;
  body.orientation = rotation(settings.rotation_deg) * math::conjugate(body.solid->axes);
  body.position = placed.origin - math::rotate(body.orientation, body.solid->origin);
  body.velocity = settings.velocity;
  body.angular_velocity = settings.angular_velocity;
  impl_->plan_refinement(body);
  impl_->rigid.add(body);
  impl_->bodies.push_back(std::move(body));
  impl_->contact_scratch.bodies.resize(impl_->bodies.size());
  impl_->keep(settings);
  return BodyId{static_cast<std::uint32_t>(impl_->bodies.size() - 1)};
}

Result<void> World::push_ground(const GroundPush& push) {
  if (!is_finite(push.position) || !is_finite(push.velocity) || !(push.radius > 0) || !std::isfinite(push.radius))
    return fail({.key = "push",
                 .problem = fmt::format("radius {}, velocity ({}, {}, {})", push.radius, push.velocity.x,
                                        push.velocity.y, push.velocity.z),
                 .expected = "finite numbers and a radius above 0"});
  impl_->keep(push);
  events::push_ground(push, impl_->surface, impl_->tree.bvh, impl_->region_scratch, impl_->kicks);
  return {};
}

Result<void> World::add_bomb(const Bomb& bomb) {
  Scene alone;
  alone.bombs.push_back(bomb);
  if (Errors errors = check(alone); !errors.empty()) return tl::unexpected(std::move(errors));
  Result<Bomb> placed = place_bomb(*impl_, bomb);
  if (!placed) return tl::unexpected(placed.error());
  impl_->keep(bomb);
  impl_->bombs.push_back({*placed, false});
  std::stable_sort(impl_->bombs.begin(), impl_->bombs.end(),
                   [](const PlannedBomb& a, const PlannedBomb& b) { return a.bomb.time < b.bomb.time; });
  return {};
}

}  // namespace divot
