#include "world/place.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "geometry/posed_solid.h"
#include "meshfile/mesh_file.h"
#include "state/region.h"

namespace divot::place {
namespace {

// Points of the underside that are held against the ground, in each direction.
constexpr int kSamples = 41;
// Of a mesh file, in its own units.
constexpr double kMostCoordinate = 1e6;

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
  state::faces_near(w.surface, w.tree.bvh, column, faces);
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

// Reads the file of a hull.
Result<void> fill(const World::Impl& w, const BodySettings& body, Hull& hull) {
  if (hull.file.empty()) return {};
  const std::filesystem::path file(hull.file);
  auto mesh = meshfile::read_mesh((w.scene.folder / file).string());  // an absolute path stays as it is
  if (!mesh) {
    mesh.error().front().key = fmt::format("bodies.{}.shape", body.name);
    return tl::unexpected(mesh.error());
  }
  if (std::ranges::any_of(mesh->vertices, [](const Vec3d& p) { return length(p) > kMostCoordinate; }))
    return fail({.file = (w.scene.folder / file).string(),
                 .key = fmt::format("bodies.{}.shape", body.name),
                 .problem = "holds coordinates that are no places",
                 .expected = "expected numbers up to 1e6"});
  hull.points = std::move(mesh->vertices);
  hull.file.clear();
  return {};
}

Result<Shape> filled(const World::Impl& w, const BodySettings& body) {
  Shape shape = body.shape;
  Errors errors;
  const auto fill_one = [&](Hull* hull) {
    if (hull == nullptr) return;
    if (const auto done = fill(w, body, *hull); !done) errors.push_back(done.error().front());
  };
  fill_one(std::get_if<Hull>(&shape));
  if (auto* compound = std::get_if<Compound>(&shape))
    for (Part& part : compound->parts) fill_one(std::get_if<Hull>(&part.shape));
  if (!errors.empty()) return tl::unexpected(std::move(errors));
  return shape;
}

// Where the body's centre of mass is when its origin is at `origin`.
Vec3d center_at(const BodySettings& body, const geometry::Solid& solid, const Vec3d& origin, Quat& orientation) {
  using math::operator*;
  orientation = rotation(body.rotation_deg) * math::conjugate(solid.axes);
  return origin - math::rotate(orientation, solid.origin);
}

// Lift of a body of any shape: every vertex under it, and points all over its underside, must come to lie free. Of
// ground in layers the highest counts; or, with `from`, that which a place so high belongs to.
std::optional<double> lift_of_any(const World::Impl& w, const BodySettings& body, const Placed& placed,
                                  std::optional<float> from = {}) {
  Quat orientation;
  const Vec3d center = center_at(body, *placed.solid, {placed.origin.x, placed.origin.y, 0}, orientation);
  geometry::PosedSolid posed;
  posed.place(*placed.solid, center, orientation);
  std::optional<double> lift;
  const auto meet = [&](double ground, double underside) {
    lift = std::max(lift.value_or(ground - underside), ground - underside);
  };
  const auto sample = [&](double x, double y) {
    const geometry::Underside under = posed.underside(x, y);
    if (!under.below) return;
    const Vec3 place{static_cast<float>(x), static_cast<float>(y), from.value_or(math::Aabb::kInf)};
    const state::SurfacePoint ground = state::surface_at(w.surface, w.tree.bvh, place, w.region_scratch);
    if (ground.found) meet(ground.position.z, under.height);
  };
  math::Aabb column;
  column.include(to_float(Vec3d{posed.low().x, posed.low().y, 0}));
  column.include(to_float(Vec3d{posed.high().x, posed.high().y, 0}));
  column.low.z = -math::Aabb::kInf, column.high.z = math::Aabb::kInf;
  std::vector<std::uint32_t> vertices;
  state::vertices_near(w.surface, w.tree.bvh, column, w.region_scratch, vertices);
  for (const std::uint32_t v : vertices) {
    const Vec3 p = w.surface.position[v];
    if (from && state::rigid_between(w.surface, p.x, p.y, *from, p.z, w.region_scratch)) continue;
    if (const geometry::Underside under = posed.underside(p.x, p.y); under.below) meet(p.z, under.height);
  }
  const Vec3d size = posed.high() - posed.low();
  for (int i = 0; i < kSamples; ++i)
    for (int k = 0; k < kSamples; ++k)
      sample(posed.low().x + size.x * (i + 0.5) / kSamples, posed.low().y + size.y * (k + 0.5) / kSamples);
  for (const geometry::PosedPiece& piece : posed.pieces()) {
    const Vec3d low = piece.lowest();
    const Vec3d middle = 0.5 * (piece.low + piece.high);
    sample(low.x + 1e-6 * (middle.x - low.x), low.y + 1e-6 * (middle.y - low.y));
    if (const auto ridge = piece.ridge({0, 0, 1}))
      for (const double t : {0.01, 0.5, 0.99})
        sample(ridge->from.x + t * (ridge->to.x - ridge->from.x), ridge->from.y + t * (ridge->to.y - ridge->from.y));
  }
  return lift;
}

// Ground that stands in a body at the start would be soil that nobody pressed away: a little is taken for rounding.
Result<void> check_underside(const World::Impl& w, const BodySettings& body, const Placed& placed, const Vec3d& center,
                             const Quat& orientation) {
  constexpr double kMost = 0.25;  // of its height
  const auto* sphere = std::get_if<Sphere>(&body.shape);
  if (sphere != nullptr) return {};
  geometry::PosedSolid posed;
  posed.place(*placed.solid, center, orientation);
  const auto touching = lift_of_any(w, body, placed, static_cast<float>(center.z));
  const double deep = touching ? *touching - placed.origin.z : 0, height = posed.high().z - posed.low().z;
  if (deep <= kMost * height) return {};
  return fail({.key = fmt::format("bodies.{}.position", body.name),
               .problem = fmt::format("its underside lies {:.3g} m below the ground", deep),
               .expected = "a place above it, or position = [x, y] for on the ground"});
}

// Its weight must not come at once onto one whose own comes bit by bit.
bool stands_on_one_set_down(const World::Impl& w, const BodySettings& body, const Placed& placed, double gap) {
  Quat orientation;
  const Vec3d center = center_at(body, *placed.solid, placed.origin, orientation);
  geometry::PosedSolid upper, lower;
  upper.place(*placed.solid, center, orientation);
  return std::any_of(w.bodies.begin(), w.bodies.end(), [&](const state::Body& other) {
    if (other.weight_share > 0 || length(other.position - center) > other.radius + placed.solid->radius + gap)
      return false;
    lower.place(*other.solid, other.position, other.orientation);
    return std::abs(upper.low().z - lower.high().z) < gap && lower.over(center.x, center.y, 0);
  });
}

}  // namespace

bool embody(state::Body& body) {
  auto solid = geometry::make_solid(body.given_shape, body.given_center, body.given_inertia);
  if (!solid) return false;
  body.solid = std::make_shared<const geometry::Solid>(std::move(*solid));
  body.shape = std::make_shared<const Shape>(geometry::drawn(body.given_shape));
  body.radius = body.solid->radius;
  body.inertia = body.mass * body.solid->inertia;
  return true;
}

Result<state::Body> prepare(const World::Impl& w, const BodySettings& settings) {
  auto shape = filled(w, settings);
  if (!shape) return tl::unexpected(shape.error());
  state::Body body{.name = settings.name, .given_shape = std::move(*shape), .given_center = settings.center_of_mass};
  if (settings.inertia) body.given_inertia = *settings.inertia * (1 / settings.mass);
  body.mass = settings.mass;
  body.restitution = settings.restitution;
  body.friction = settings.friction;
  if (embody(body)) return body;
  return fail({.key = fmt::format("bodies.{}.shape", settings.name),
               .problem = "its points span no volume",
               .expected = "at least 4 that do not lie in a plane"});
}

Placed placed(const World::Impl& w, const BodySettings& settings, const state::Body& body) {
  return {body.solid, settings.position - w.surface.origin};
}

std::optional<double> lift(const World::Impl& w, const BodySettings& body, const Placed& placed) {
  if (const auto* sphere = std::get_if<Sphere>(&body.shape))
    return resting_height(w, placed.origin.x, placed.origin.y, sphere->radius);
  return lift_of_any(w, body, placed);
}

bool is_set_down(const World::Impl& w, const BodySettings& body, const Placed& placed) {
  if (length(body.velocity) > 0 || length(body.angular_velocity) > 0) return false;
  const double gap = 0.01 * placed.solid->radius;
  const auto touching = lift(w, body, placed);
  return (touching && placed.origin.z - *touching < gap) || stands_on_one_set_down(w, body, placed, gap);
}

Result<void> check_place(const World::Impl& w, const BodySettings& body, const Placed& placed) {
  Quat orientation;
  const Vec3d center = center_at(body, *placed.solid, placed.origin, orientation);
  const state::SurfacePoint ground = state::surface_at(w.surface, w.tree.bvh, to_float(center), w.region_scratch);
  if (body.above_ground || !ground.found) return {};
  if (center.z >= ground.position.z) return check_underside(w, body, placed, center, orientation);
  return fail({.key = fmt::format("bodies.{}.position", body.name),
               .problem = fmt::format("its centre lies {:.3g} m below the ground", ground.position.z - center.z),
               .expected = "a place above it, or position = [x, y] for on the ground"});
}

Error no_ground(const World::Impl& w, std::string key, const Vec3d& place) {
  const math::Aabb box = w.tree.bvh.boxes(0).front();
  const Vec3d low = to_double(box.low) + w.surface.origin, high = to_double(box.high) + w.surface.origin;
  return {.key = std::move(key),
          .problem = fmt::format("there is no ground below ({}, {})", place.x, place.y),
          .expected = fmt::format("a place on the terrain (x from {:.0f} to {:.0f}, y from {:.0f} to {:.0f}), or a "
                                  "height of its own: position = [x, y, z]",
                                  low.x, high.x, low.y, high.y)};
}

}  // namespace divot::place
