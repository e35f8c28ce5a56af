#include "divot/world.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/hash.h"
#include "output/resample.h"
#include "world/measure.h"
#include "world/state.h"

namespace divot {

World::World(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;
World::~World() = default;

double World::time() const { return impl_->time(); }
std::uint64_t World::steps() const { return impl_->step_count; }
const Scene& World::scene() const { return impl_->scene; }
std::span<const Material> World::materials() const { return impl_->materials; }
std::size_t World::peak_particles() const { return impl_->peak_particles; }

SurfaceView World::surface() const {
  const state::Surface& s = impl_->surface;
  const std::size_t rigid = s.rigid.triangles.size() / 3;
  return {s.origin, s.position, rigid > 0 ? impl_->triangles : s.mesh.triangles(), s.material, s.spacing, rigid};
}

ParticleView World::particles() const {
  const state::Particles& p = impl_->particles;
  return {p.vertex, p.x, p.y, p.z, p.vx, p.vy, p.vz, p.mass, p.hold};
}

std::vector<BodyView> World::bodies() const {
  std::vector<BodyView> views;
  for (const state::Body& b : impl_->bodies)
    views.push_back({b.name, b.radius, b.mass,
                     b.position + math::rotate(b.orientation, b.solid->origin) + impl_->surface.origin,
                     math::operator*(b.orientation, b.solid->axes), b.velocity, b.angular_velocity, b.sinkage,
                     b.max_sinkage, b.touching, b.off_terrain, b.shape});
  return views;
}

std::vector<BombView> World::bombs() const {
  std::vector<BombView> views;
  for (const PlannedBomb& b : impl_->bombs) views.push_back({b.bomb.position, b.bomb.time, b.bomb.yield, b.exploded});
  return views;
}

std::vector<DirtyRange> World::take_dirty() {
  std::vector<DirtyRange> ranges;
  const auto end = static_cast<std::uint32_t>(impl_->surface.position.size());
  for (std::uint32_t chunk = 0; chunk < impl_->dirty_chunk.size(); ++chunk) {
    if (!impl_->dirty_chunk[chunk]) continue;
    const std::uint32_t first = chunk * kDirtyChunk, last = std::min(first + kDirtyChunk, end);
    if (!ranges.empty() && ranges.back().second == first)
      ranges.back().second = last;
    else
      ranges.emplace_back(first, last);
  }
  impl_->dirty_chunk.assign(impl_->dirty_chunk.size(), false);
  return ranges;
}

Topology World::take_topology() {
  Topology topology;
  state::Surface& surface = impl_->surface;
  if (!surface.bisection.started()) return topology;
  std::vector<std::uint32_t> faces, vertices;
  surface.bisection.changed().drain(faces);
  impl_->retriangulated.drain(vertices);
  const auto rigid = static_cast<std::uint32_t>(surface.rigid.triangles.size() / 3);  // views have them first
  for (std::uint32_t face : faces) {
    face += rigid;
    if (!topology.triangles.empty() && topology.triangles.back().second == face)
      ++topology.triangles.back().second;
    else
      topology.triangles.emplace_back(face, face + 1);
  }
  const std::uint32_t base = surface.bisection.base_vertex_count();
  impl_->shown.resize(surface.position.size() - base, false);
  for (const std::uint32_t vertex : vertices) {
    const bool there = surface.mesh.outgoing(vertex) != kNone;
    if (there != impl_->shown[vertex - base]) (there ? topology.added : topology.removed).push_back(vertex);
    impl_->shown[vertex - base] = there;
  }
  return topology;
}

RefinementCounts World::refinement() const {
  const geometry::Bisection& bisection = impl_->surface.bisection;
  if (!bisection.started()) return {};
  const refine::Progress& progress = impl_->refine_progress;
  return {.on = true,
          .edge = impl_->refine_limits.edge,
          .base_vertices = bisection.base_vertex_count(),
          .vertices = bisection.added_count(),
          .most = progress.most,
          .budget = impl_->refine_limits.budget,
          .halved = progress.halved,
          .joined = progress.joined,
          .short_steps = progress.short_steps};
}

float World::sinkage(std::uint32_t vertex) const { return measure::sinkage(impl_->surface, impl_->soil, vertex); }

float World::pressure(std::uint32_t vertex) const {
  return measure::pressure(impl_->surface, impl_->soil, impl_->media, vertex);
}

double World::ground_height(double x, double y) const {
  const Vec3d origin = impl_->surface.origin;
  const state::SurfacePoint point = state::surface_at(impl_->surface, impl_->tree.bvh, static_cast<float>(x - origin.x),
                                                      static_cast<float>(y - origin.y), impl_->region_scratch);
  return point.found ? point.position.z + origin.z : std::numeric_limits<double>::quiet_NaN();
}

std::optional<RasterView> World::raster(double spacing) const {
  if (!impl_->surface.raster) return std::nullopt;
  return output::resample(impl_->surface, impl_->soil, spacing);
}

std::vector<std::pair<Vec3, Vec3>> World::bvh_boxes(int level) const {
  std::vector<std::pair<Vec3, Vec3>> boxes;
  for (const math::Aabb& box : impl_->tree.bvh.boxes(level)) boxes.emplace_back(box.low, box.high);
  return boxes;
}

std::vector<StageTime> World::stages() const {
  std::vector<StageTime> rows;
  for (std::size_t i = 0; i < static_cast<std::size_t>(Stage::count); ++i)
    rows.push_back({kStageNames[i], impl_->timers.ms(i), impl_->timers.calls(i)});
  return rows;
}

UpdateCounts World::updates() const {
  return {impl_->neighbours.rebuilds, impl_->tree.refits, impl_->tree.rebuilds, impl_->neighbours.missed_pairs};
}

std::vector<Crater> World::craters() const {
  std::vector<Crater> craters;
  for (const state::Blast& blast : impl_->blasts)
    craters.push_back(measure::crater(blast, impl_->surface, impl_->soil, impl_->tree.bvh, impl_->region_scratch));
  return craters;
}

SoilVolume World::soil_volume() const { return measure::soil_volume(impl_->surface, impl_->soil); }

Energy World::energy() const {
  return measure::energy(impl_->bodies, impl_->particles, impl_->scene.gravity, impl_->surface.origin);
}

double SoilVolume::relative_error() const {
  return displaced > 0 ? std::abs(displaced - compacted - deposited) / displaced : 0;
}

std::uint64_t World::state_hash() const {
  core::Hash hash;
  for (const Vec3& p : impl_->surface.position) hash.add(p.x), hash.add(p.y), hash.add(p.z);
  const state::Particles& p = impl_->particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    hash.add(static_cast<std::uint64_t>(p.vertex[i]));
    for (const float number : {p.x[i], p.y[i], p.z[i], p.vx[i], p.vy[i], p.vz[i]}) hash.add(number);
  }
  for (const state::Body& b : impl_->bodies)
    for (const double number : {b.position.x, b.position.y, b.position.z, b.velocity.x, b.velocity.y, b.velocity.z,
                                b.orientation.x, b.orientation.y, b.orientation.z, b.orientation.w})
      hash.add(number);
  return hash.value();
}

}  // namespace divot
