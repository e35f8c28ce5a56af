// What a world is made of, as bytes and back. Every array that a stage leaves to a later step is listed here once, for
// both ways. What is not listed is scratch, or follows from the scene: materials, media, the terrain as it was loaded,
// the bounding volumes, solids of bodies.
#include <fmt/format.h>

#include <algorithm>

#include "core/archive.h"
#include "world/place.h"
#include "world/state.h"

namespace divot {
namespace core {

template <>
inline constexpr bool kPlain<geometry::Bisection::Node> = true;
template <>
inline constexpr bool kPlain<geometry::Bisection::Birth> = true;

template <class Archive, class Enum>
void one_of(Archive& a, Enum& value, std::size_t end) {
  if constexpr (Archive::kReads)
    a.choice(value, end);
  else
    a(value);
}

template <class Archive, Is<Bomb> T>
void archive(Archive& a, T& b) {
  a(b.time, b.position, b.above_ground, b.depth, b.yield);
}
template <class Archive, Is<PlannedBomb> T>
void archive(Archive& a, T& b) {
  a(b.bomb, b.exploded);
}
template <class Archive, Is<state::Blast> T>
void archive(Archive& a, T& b) {
  a(b.ground_zero, b.direction, b.yield, b.height, b.start, b.pulse, b.flow_rate, b.column, b.push, b.thrown, b.landing,
    b.landing_height, b.radius, b.active);
}
template <class Archive, Is<Sphere> T>
void archive(Archive& a, T& s) {
  a(s.radius);
}
template <class Archive, Is<Box> T>
void archive(Archive& a, T& s) {
  a(s.size);
}
template <class Archive, Is<Cylinder> T>
void archive(Archive& a, T& s) {
  a(s.radius, s.length);
}
template <class Archive, Is<Capsule> T>
void archive(Archive& a, T& s) {
  a(s.radius, s.length);
}
template <class Archive, Is<Cone> T>
void archive(Archive& a, T& s) {
  a(s.radius, s.height);
}
template <class Archive, Is<Hull> T>
void archive(Archive& a, T& s) {
  a(s.file, s.scale, s.points, s.triangles);
}
template <class Archive, Is<Part> T>
void archive(Archive& a, T& p) {
  a(p.shape, p.position, p.rotation_deg);
}
template <class Archive, Is<Compound> T>
void archive(Archive& a, T& c) {
  a(c.parts);
}
template <class Archive, Is<state::Body> T>
void archive(Archive& a, T& b) {
  a(b.name, b.given_shape, b.given_center, b.given_inertia, b.mass, b.restitution, b.friction, b.position, b.velocity,
    b.angular_velocity, b.orientation, b.edge, b.spacing, b.refined_from, b.refined_to, b.refined_left, b.near,
    b.near_left, b.last_vertex, b.touching, b.patch_width, b.weight_share, b.impact_speed, b.held_impulse,
    b.last_impulse, b.sinkage, b.max_sinkage, b.off_terrain);
}
template <class Archive, Is<contact::Press> T>
void archive(Archive& a, T& p) {
  a(p.vertex, p.position, p.shear, p.plastic, p.pressure, p.load);
}
template <class Archive, Is<Profile> T>
void archive(Archive& a, T& p) {
  a(p.points);
}
template <class Archive, Is<Joint> T>
void archive(Archive& a, T& j) {
  a(j.name);
  one_of(a, j.type, 5);
  a(j.first, j.second, j.anchor, j.axis, j.axle, j.stiffness, j.damping, j.preload, j.lower, j.upper, j.motor_speed,
    j.motor_force, j.steering_deg, j.collide);
}
template <class Archive, Is<state::JointFrame> T>
void archive(Archive& a, T& f) {
  a(f.anchor, f.axes);
}
template <class Archive, Is<state::HeldJoint> T>
void archive(Archive& a, T& j) {
  a(j.settings, j.first, j.second, j.on_first, j.on_second, j.motor, j.steering_deg, j.impulse, j.turn, j.position,
    j.speed, j.motor_force);
}
template <class Archive, Is<events::Kick> T>
void archive(Archive& a, T& k) {
  a(k.vertex, k.velocity);
}
template <class Archive, Is<state::Soil> T>
void archive(Archive& a, T& s) {
  a(s.vertex, s.particle, s.original, s.rest, s.plastic, s.shear, s.area, s.cell, s.gained, s.compacted, s.loose,
    s.excess, s.restless);
}
template <class Archive, Is<state::Bonds> T>
void archive(Archive& a, T& b) {
  a(b.count, b.first, b.neighbour, b.medium, b.rest_length);
}

// Triangles that the terrain did not start with.
template <class Archive, class Impl>
void archive_triangles(Archive& a, Impl& w) {
  auto& surface = w.surface;
  bool on = surface.bisection.started();
  const std::uint32_t base = surface.mesh.vertex_count(), faces = surface.mesh.face_count();
  a(on, surface.spacing);
  if constexpr (Archive::kReads) {
    if (!(surface.spacing > 0)) return a.fail();
    if (!on) surface.bisection = {};
  }
  if (!on) return;
  std::vector<std::uint32_t> triangles;
  std::vector<Vec3> position;
  std::vector<std::uint8_t> material;
  if constexpr (!Archive::kReads) {
    triangles.assign(surface.mesh.triangles().begin(), surface.mesh.triangles().end());
    const auto first = static_cast<std::ptrdiff_t>(surface.bisection.base_vertex_count());
    position.assign(surface.position.begin() + first, surface.position.end());
    material.assign(surface.material.begin() + first, surface.material.end());
  }
  a(triangles, position, material, surface.strayed, w.refine_limits.edge, w.refine_limits.base,
    w.refine_limits.tolerance, w.refine_limits.budget, w.refine_progress.next, w.refine_progress.halved,
    w.refine_progress.joined, w.refine_progress.most, w.refine_progress.short_steps);
  surface.bisection.for_each_value([&](auto& value) { a(value); });
  if constexpr (Archive::kReads) {
    const std::size_t vertices = base + position.size();
    const auto good = [&](std::uint8_t m) { return m < w.media.size(); };
    if (material.size() != position.size() || !std::ranges::all_of(material, good) ||
        !std::ranges::all_of(position, [](const Vec3& p) { return is_finite(p); }) || vertices >= kNone ||
        surface.bisection.base_vertex_count() != base || surface.bisection.base_face_count() != faces ||
        !(w.refine_limits.edge > 0) || !std::isfinite(w.refine_limits.base))
      return a.fail();
    auto mesh = geometry::HalfEdgeMesh::build(static_cast<std::uint32_t>(vertices), std::move(triangles));
    if (!mesh || !surface.bisection.fits(*mesh)) return a.fail();
    surface.mesh = std::move(*mesh);
    surface.position.insert(surface.position.end(), position.begin(), position.end());
    surface.material.insert(surface.material.end(), material.begin(), material.end());
    surface.column.resize(vertices, kNone);
    for (std::size_t v = base; v < vertices; ++v)
      w.shown.push_back(surface.mesh.outgoing(static_cast<std::uint32_t>(v)) != kNone);
    w.dirty_chunk.resize(vertices / kDirtyChunk + 1, false);
    const auto& wanted = w.scene.terrain.refine;
    if (w.refine_limits.budget > wanted.budget || vertices - base > wanted.budget) return a.fail();
    w.list_triangles();
  }
}

// Of the ground only what was ever touched can have moved or be of another material.
template <class Archive, class Impl>
void archive_touched(Archive& a, Impl& w) {
  a(w.soil);
  std::vector<Vec3> position(w.soil.size());
  std::vector<std::uint8_t> material(w.soil.size());
  if constexpr (!Archive::kReads) {
    for (std::size_t c = 0; c < w.soil.size(); ++c)
      position[c] = w.surface.position[w.soil.vertex[c]], material[c] = w.surface.material[w.soil.vertex[c]];
  }
  a(position, material);
  if constexpr (Archive::kReads) {
    if (position.size() != w.soil.size() || material.size() != w.soil.size()) return a.fail();
    for (std::size_t c = 0; c < w.soil.size(); ++c) {
      const std::uint32_t vertex = w.soil.vertex[c];
      const bool good = vertex < w.surface.position.size() && w.surface.column[vertex] == kNone &&
                        material[c] < w.media.size() && is_finite(position[c]);
      if (!good) return a.fail();
      w.surface.position[vertex] = position[c], w.surface.material[vertex] = material[c];
      w.surface.column[vertex] = static_cast<std::uint32_t>(c);
    }
  }
}

template <class Archive, class Impl>
void archive_contact(Archive& a, Impl& w) {
  if constexpr (Archive::kReads) w.contact_scratch.bodies.resize(w.bodies.size());
  for (auto& own : w.contact_scratch.bodies) a(own.presses, own.last);
}

template <class Archive, Is<World::Impl> T>
void archive(Archive& a, T& w) {
  a(w.step_count, w.peak_particles, w.bodies, w.joints, w.bombs, w.blasts);
  archive_triangles(a, w);
  archive_touched(a, w);
  w.particles.for_each_array([&](auto& array) { a(array); });
  a(w.bonds, w.least_mass, w.wake, w.kicks, w.moved.distance, w.moved.free_distance);
  a(w.neighbours.vertex, w.neighbours.x, w.neighbours.y, w.neighbours.steps_since_build, w.neighbours.rebuilds,
    w.neighbours.missed_pairs, w.tree.steps, w.tree.refits, w.tree.rebuilds);
  archive_contact(a, w);
}

template <class Archive, class Timers>
void archive_timers(Archive& a, Timers& timers) {
  auto totals = timers.totals();
  a(totals.ms, totals.calls);
  if constexpr (Archive::kReads) timers.go_on_from(totals);
}

}  // namespace core

namespace {

bool below(const std::vector<std::uint32_t>& ids, std::size_t end) {
  return std::ranges::all_of(ids, [&](std::uint32_t id) { return id < end; });
}
bool below_or_none(const std::vector<std::uint32_t>& ids, std::size_t end) {
  return std::ranges::all_of(ids, [&](std::uint32_t id) { return id < end || id == kNone; });
}
template <class T>
bool ascends(const std::vector<T>& ids) {
  return std::ranges::adjacent_find(ids, std::greater_equal<T>{}) == ids.end();
}
template <class... Lists>
bool all_of_size(std::size_t size, const Lists&... lists) {
  return ((lists.size() == size) && ...);
}

bool holds_together(const state::Soil& s, std::size_t vertices, std::size_t particles) {
  return all_of_size(s.size(), s.particle, s.original, s.rest, s.plastic, s.shear, s.area, s.cell, s.gained,
                     s.compacted, s.loose, s.excess) &&
         below_or_none(s.particle, particles) && below(s.restless, vertices) && ascends(s.restless);
}

bool holds_together(const state::Particles& p, const World::Impl& w) {
  bool good = true;
  p.for_each_array([&](const auto& array) { good = good && array.size() == p.size(); });
  if (!good || !ascends(p.vertex) || !below(p.vertex, w.surface.position.size())) return false;
  for (std::size_t i = 0; i < p.size(); ++i) {
    good = good && p.column[i] == w.surface.column[p.vertex[i]] && p.column[i] != kNone &&
           w.soil.particle[p.column[i]] == i && p.material[i] < w.media.size() && p.hold[i] <= Hold::asleep &&
           is_finite(p.position(i)) && is_finite(p.velocity(i)) && p.mass[i] > 0 && std::isfinite(p.mass[i]) &&
           (p.carrier[i] == kNone || p.carrier[i] < w.bodies.size());
  }
  const auto awake = std::ranges::count_if(w.soil.particle, [](std::uint32_t i) { return i != kNone; });
  return good && static_cast<std::size_t>(awake) == p.size();
}

bool holds_together(const state::Bonds& b, const neighbours::Index& index, std::size_t media) {
  constexpr std::size_t kLanes = state::Bonds::kLanes;
  const std::size_t blocks = (b.count + kLanes - 1) / kLanes;
  if (b.first.empty()) return b.count == 0 && b.neighbour.empty() && b.rest_length.empty();
  return b.block_count() == blocks && b.first[0] == 0 && std::ranges::is_sorted(b.first) &&
         all_of_size(std::size_t{b.first.back()} * kLanes, b.neighbour, b.rest_length) &&
         all_of_size(blocks, b.medium) && below(b.neighbour, b.count) &&
         all_of_size(b.count, index.vertex, index.x, index.y) && ascends(index.vertex) &&
         std::ranges::all_of(b.medium, [&](std::uint8_t m) { return m < media || m == state::Bonds::kSeveral; });
}

bool holds_together(const state::Blast& b, std::size_t columns) {
  return all_of_size(b.column.size(), b.push, b.thrown) && all_of_size(b.landing.size(), b.landing_height) &&
         below(b.column, columns) && below(b.landing, columns) && is_finite(b.ground_zero) && is_finite(b.direction);
}

bool holds_together(const state::Body& b, std::size_t vertices) {
  return is_finite(b.position) && is_finite(b.velocity) && is_finite(b.angular_velocity) && b.mass > 0 &&
         std::isfinite(b.mass) && below(b.near, vertices) && ascends(b.near) &&
         (b.last_vertex < vertices || b.last_vertex == kNone) && b.spacing > 0 && std::isfinite(b.spacing) &&
         b.edge >= 0;
}

bool holds_together(const std::vector<contact::Press>& presses, const state::Surface& surface) {
  const auto good = [&](const contact::Press& p) {
    return p.vertex < surface.column.size() && surface.column[p.vertex] != kNone && is_finite(p.position);
  };
  return std::ranges::all_of(presses, good) &&
         std::ranges::adjacent_find(presses, std::greater_equal<>{}, &contact::Press::vertex) == presses.end();
}

// Bytes that are whole need not be those of a world: nothing in them may lead out of an array.
bool holds_together(const World::Impl& w) {
  const std::size_t vertices = w.surface.position.size();
  bool good = holds_together(w.soil, vertices, w.particles.size()) && holds_together(w.particles, w) &&
              holds_together(w.bonds, w.neighbours, w.media.size()) && below(w.wake, vertices) &&
              all_of_size(w.bodies.size(), w.contact_scratch.bodies) &&
              (w.particles.size() == 0 || w.least_mass.size() == w.media.size());
  for (const state::Blast& blast : w.blasts) good = good && holds_together(blast, w.soil.size());
  for (const state::Body& body : w.bodies) good = good && holds_together(body, vertices);
  for (const auto& own : w.contact_scratch.bodies)
    good = good && holds_together(own.presses, w.surface) && holds_together(own.last, w.surface);
  for (const events::Kick& kick : w.kicks) good = good && kick.vertex < vertices && is_finite(kick.velocity);
  for (const state::HeldJoint& joint : w.joints)
    good = good && joint.second < w.bodies.size() && (joint.first < w.bodies.size() || joint.first == kNone);
  return good;
}

// Nor may they hold what no scene could.
bool is_possible(const World::Impl& w) {
  Scene held;
  for (const state::Body& b : w.bodies) {
    BodySettings& settings = held.bodies.emplace_back(BodySettings{.name = b.name, .shape = b.given_shape});
    settings.mass = b.mass, settings.restitution = b.restitution, settings.friction = b.friction;
    settings.center_of_mass = b.given_center;
    if (b.given_inertia) settings.inertia = *b.given_inertia * b.mass;
  }
  for (const state::HeldJoint& j : w.joints) held.joints.push_back(j.settings);
  for (const PlannedBomb& b : w.bombs) held.bombs.push_back(b.bomb);
  return check(held).empty();
}

// How lanes find their neighbours follows from who they are.
void find_reads(state::Bonds& bonds) {
  constexpr std::uint32_t kLanes = state::Bonds::kLanes;
  bonds.reads.resize(bonds.neighbour.size() / kLanes);
  for (std::size_t slot = 0; slot < bonds.reads.size(); ++slot) {
    std::array<std::uint32_t, kLanes> pairs;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t entry = slot * kLanes + lane;
      pairs[lane] = bonds.rest_length[entry] < 0 ? kNone : bonds.neighbour[entry];
    }
    bonds.reads[slot] = state::find_reads(pairs, bonds.count);
  }
}

// The scene without what the bytes hold: bodies, joints and bombs.
Scene ground_of(const Scene& scene) {
  Scene ground = scene;
  ground.bodies.clear(), ground.joints.clear(), ground.bombs.clear();
  return ground;
}

tl::unexpected<Errors> damaged() {
  return fail({.problem = "the state of a world is damaged", .expected = "expected the bytes that World::save() gave"});
}

}  // namespace

std::string World::save() const {
  const Impl& w = *impl_;
  core::ByteWriter writer;
  writer(scene_fingerprint(), w.terrain_fingerprint, w.rigid.save());
  archive(writer, w);
  core::archive_timers(writer, w.timers);
  return writer.take();
}

Result<World> World::restore(std::string_view bytes, const Scene& scene, std::shared_ptr<const Jobs> jobs) {
  if (Errors errors = check(scene); !errors.empty()) return tl::unexpected(std::move(errors));
  auto world = create(ground_of(scene), std::move(jobs));
  if (!world) return world;
  Impl& w = *world->impl_;
  w.scene = scene;

  core::ByteReader reader(bytes);
  std::uint64_t scene_then = 0, terrain_then = 0;
  std::string touching;
  reader(scene_then, terrain_then, touching);
  if (!reader.ok()) return damaged();
  if (scene_then != world->scene_fingerprint())
    return fail({.problem = "the scene is not the one whose world was saved",
                 .expected = "only duration and output may differ"});
  if (terrain_then != w.terrain_fingerprint)
    return fail({.key = "terrain",
                 .problem = "the ground is not that of the world that was saved",
                 .expected = "the same files of heights, meshes and materials"});
  archive(reader, w);
  core::archive_timers(reader, w.timers);
  if (!reader.ok() || !reader.at_end() || !holds_together(w) || !is_possible(w)) return damaged();

  find_reads(w.bonds);
  for (state::Body& body : w.bodies) {
    if (!place::embody(body)) return damaged();
    w.rigid.add(body);
  }
  for (const state::HeldJoint& joint : w.joints) w.rigid.add(joint);
  if (!w.rigid.restore(touching)) return damaged();
  // Boxes anew: which places they hold does not depend on how they came to be.
  const auto [steps, refits, rebuilds] = std::tuple(w.tree.steps, w.tree.refits, w.tree.rebuilds);
  w.reserve_budget();
  w.tree.margin =
      kBoxMargin * (w.surface.bisection.started() ? static_cast<float>(w.refine_limits.base) : w.surface.spacing);
  refit::build(w.tree, w.surface, *w.jobs);
  w.tree.steps = steps, w.tree.refits = refits, w.tree.rebuilds = rebuilds;
  return world;
}

}  // namespace divot
