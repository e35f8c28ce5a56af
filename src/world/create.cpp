#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "terrain/material_map.h"
#include "terrain/terrain.h"
#include "world/state.h"

namespace divot {
namespace {

// Boxes of the BVH are larger than their faces by this share of the spacing, so that most steps need no refit.
constexpr float kMargin = 0.1f;

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

std::vector<laws::Medium> media_of(const std::vector<Material>& materials) {
  std::vector<laws::Medium> media;
  for (const Material& material : materials) {
    media.push_back(laws::make_medium(material));
    if (material.over.empty()) continue;
    const auto below = std::ranges::find(materials, material.over, &Material::name);
    media.back().below = static_cast<std::uint8_t>(below - materials.begin());
  }
  return media;
}

// Height of a ball's centre over x, y at which it touches the plane of a face, if it would touch it inside the face.
std::optional<double> height_on_face(const std::array<Vec3, 3>& corner, double x, double y, double radius) {
  const Vec3d a = to_double(corner[0]), b = to_double(corner[1]), c = to_double(corner[2]);
  const Vec3d across = cross(b - a, c - a);
  const double size = length(across);
  if (!(across.z > 0)) return std::nullopt;
  const Vec3d normal = across * (1 / size);
  const double px = x - radius * normal.x, py = y - radius * normal.y;
  const auto side = [&](const Vec3d& p, const Vec3d& q) { return (q.x - p.x) * (py - p.y) - (q.y - p.y) * (px - p.x); };
  if (side(a, b) < 0 || side(b, c) < 0 || side(c, a) < 0) return std::nullopt;
  return a.z - (normal.x * (px - a.x) + normal.y * (py - a.y)) / normal.z + radius * normal.z;
}

// Height of the centre at which a ball over x, y just rests on the ground: on a face or on a vertex.
std::optional<double> resting_height(const World::Impl& w, double x, double y, double radius) {
  const float r = static_cast<float>(radius), px = static_cast<float>(x), py = static_cast<float>(y);
  const state::SurfacePoint below = state::surface_at(w.surface, w.tree.bvh, px, py, w.region_scratch);
  if (!below.found) return std::nullopt;
  math::Aabb column;
  column.include(Vec3{px - r, py - r, -math::Aabb::kInf});
  column.include(Vec3{px + r, py + r, math::Aabb::kInf});
  std::vector<std::uint32_t> faces;
  w.tree.bvh.query(column, faces);
  double height = below.position.z + radius;
  for (const std::uint32_t face : faces) {
    std::array<Vec3, 3> corner;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Vec3 p = corner[k] = w.surface.position[w.surface.mesh.origin(3 * face + k)];
      const double rise = radius * radius - (p.x - x) * (p.x - x) - (p.y - y) * (p.y - y);
      if (rise > 0) height = std::max(height, p.z + std::sqrt(rise));
    }
    height = std::max(height, height_on_face(corner, x, y, radius).value_or(height));
  }
  return height;
}

Result<Vec3d> place_body(const World::Impl& w, const BodySettings& body) {
  const Vec3d local = body.position - w.surface.origin;
  const state::SurfacePoint ground = state::surface_at(w.surface, w.tree.bvh, static_cast<float>(local.x),
                                                       static_cast<float>(local.y), w.region_scratch);
  if (!body.above_ground && ground.found && local.z < ground.position.z)
    return fail({.key = fmt::format("bodies.{}.position", body.name),
                 .problem = fmt::format("its centre lies {:.3g} m below the ground", ground.position.z - local.z),
                 .expected = "a place above it, or position = [x, y] for on the ground"});
  if (!body.above_ground) return local;
  const auto height = resting_height(w, local.x, local.y, body.shape.radius);
  if (!height)
    return fail({.key = fmt::format("bodies.{}.position", body.name),
                 .problem = fmt::format("there is no ground below ({}, {})", body.position.x, body.position.y),
                 .expected = "a place on the terrain, or a height of its own: position = [x, y, z]"});
  return Vec3d{local.x, local.y, *height + body.position.z};
}

Result<Bomb> place_bomb(const World::Impl& w, Bomb bomb) {
  bomb.position.z -= bomb.depth;
  bomb.depth = 0;
  if (!bomb.above_ground) return bomb;
  const Vec3d local = bomb.position - w.surface.origin;
  const state::SurfacePoint ground = state::surface_at(w.surface, w.tree.bvh, static_cast<float>(local.x),
                                                       static_cast<float>(local.y), w.region_scratch);
  if (!ground.found)
    return fail({.key = "bombs",
                 .problem = fmt::format("there is no ground below ({}, {})", bomb.position.x, bomb.position.y),
                 .expected = "a place on the terrain, or a height of its own: position = [x, y, z]"});
  bomb.position.z += ground.position.z + w.surface.origin.z;
  bomb.above_ground = false;
  return bomb;
}

}  // namespace

Result<World> World::create(const Scene& scene, std::shared_ptr<const Jobs> jobs) {
  if (Errors errors = check(scene); !errors.empty()) return tl::unexpected(std::move(errors));
  auto surface = terrain::load_terrain(scene);
  if (!surface) return tl::unexpected(std::move(surface.error()));

  auto impl = std::make_unique<Impl>();
  impl->scene = scene;
  impl->jobs = jobs ? std::move(jobs) : std::make_shared<const Jobs>(1);
  impl->materials = materials_in_use(scene);
  if (impl->materials.size() > laws::kNoLayer)
    return fail({.key = "materials",
                 .problem = fmt::format("the ground is made of {} materials", impl->materials.size()),
                 .expected = fmt::format("expected at most {}", laws::kNoLayer)});
  impl->media = media_of(impl->materials);
  if (auto ok = terrain::place_materials(scene, impl->materials, *surface); !ok) return tl::unexpected(ok.error());
  impl->surface = std::move(*surface);
  impl->lowest = math::Aabb::kInf;
  for (const Vec3& p : impl->surface.position) impl->lowest = std::min<double>(impl->lowest, p.z);
  impl->dirty_chunk.assign(impl->surface.position.size() / kDirtyChunk + 1, false);
  impl->tree.margin = kMargin * impl->surface.spacing;
  refit::build(impl->tree, impl->surface, *impl->jobs);

  World world(std::move(impl));
  Errors errors;
  const auto keep_errors = [&](const auto& result) {
    if (!result) errors.insert(errors.end(), result.error().begin(), result.error().end());
  };
  for (const BodySettings& body : scene.bodies) keep_errors(world.spawn(body));
  for (const Bomb& bomb : scene.bombs) keep_errors(world.add_bomb(bomb));
  if (!errors.empty()) return tl::unexpected(std::move(errors));
  return world;
}

Result<BodyId> World::spawn(const BodySettings& settings) {
  Scene alone;
  alone.bodies.push_back(settings);
  if (Errors errors = check(alone); !errors.empty()) return tl::unexpected(std::move(errors));
  const Result<Vec3d> position = place_body(*impl_, settings);
  if (!position) return tl::unexpected(position.error());

  const double r = settings.shape.radius;
  state::Body body;
  body.name = settings.name;
  body.radius = r;
  body.mass = settings.mass;
  body.inertia = 0.4 * settings.mass * r * r;
  body.restitution = settings.restitution;
  body.friction = settings.friction;
  body.position = *position;
  body.velocity = settings.velocity;
  body.angular_velocity = settings.angular_velocity;
  impl_->rigid.add(body);
  impl_->bodies.push_back(std::move(body));
  return BodyId{static_cast<std::uint32_t>(impl_->bodies.size() - 1)};
}

Result<void> World::push_ground(const GroundPush& push) {
  if (!is_finite(push.position) || !is_finite(push.velocity) || !(push.radius > 0) || !std::isfinite(push.radius))
    return fail({.key = "push",
                 .problem = fmt::format("radius {}, velocity ({}, {}, {})", push.radius, push.velocity.x,
                                        push.velocity.y, push.velocity.z),
                 .expected = "finite numbers and a radius above 0"});
  events::push_ground(push, impl_->surface, impl_->tree.bvh, impl_->region_scratch, impl_->kicks);
  return {};
}

Result<void> World::add_bomb(const Bomb& bomb) {
  Scene alone;
  alone.bombs.push_back(bomb);
  if (Errors errors = check(alone); !errors.empty()) return tl::unexpected(std::move(errors));
  Result<Bomb> placed = place_bomb(*impl_, bomb);
  if (!placed) return tl::unexpected(placed.error());
  impl_->bombs.push_back({*placed, false});
  std::stable_sort(impl_->bombs.begin(), impl_->bombs.end(),
                   [](const PlannedBomb& a, const PlannedBomb& b) { return a.bomb.time < b.bomb.time; });
  return {};
}

}  // namespace divot
