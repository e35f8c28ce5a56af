#include "viewer/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace divot::viewer {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
// Low enough above the horizon for relief, high enough to see into a crater; standing a little east of south.
constexpr double kElevation = 31 * kDegree;
constexpr double kAzimuth = 24 * kDegree;
constexpr double kFillWhole = 0.96;   // share of the picture that the whole terrain takes up
constexpr double kFillPart = 0.85;    // and what is framed on terrain that goes on around it
constexpr double kBodyMargin = 1.15;  // of the radius around a body
constexpr double kBlock = 0.045;      // thickness of the terrain's block over its extent
// What is wider than this share of the terrain shows all of it. Bodies alone need room to go somewhere, while bombs
// tell where something will happen.
constexpr double kWholeTerrain = 0.5, kWholeTerrainBodies = 0.15;

// Reach of a crater with its lip and blanket: about one apparent width, which is 7.13 m for 1 t by eq. 10.
double blast_reach(double yield) { return 7.13 * std::cbrt(yield); }

Region empty_region() {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  return {.min = {kFar, kFar, kFar}, .max = {-kFar, -kFar, -kFar}};
}

void include(Region& region, const Vec3d& center, double reach) {
  region.min = {std::min(region.min.x, center.x - reach), std::min(region.min.y, center.y - reach),
                std::min(region.min.z, center.z - reach)};
  region.max = {std::max(region.max.x, center.x + reach), std::max(region.max.y, center.y + reach),
                std::max(region.max.z, center.z + reach)};
}

Vec3d unit(const Vec3d& a) { return a * (1 / length(a)); }

// What must be in the picture: a ball, or a point where the radius is 0.
struct Subject {
  Vec3d center;
  double radius = 0;
};

void add_corners(const Region& r, std::vector<Subject>& subjects) {
  for (const double x : {r.min.x, r.max.x}) {
    for (const double y : {r.min.y, r.max.y}) {
      for (const double z : {r.min.z, r.max.z}) subjects.push_back({.center = {x, y, z}});
    }
  }
}

// The ground that a bomb will move, as points around it.
void add_crater(const BombView& bomb, std::vector<Subject>& subjects) {
  constexpr int kPoints = 12;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * std::numbers::pi * i / kPoints, reach = blast_reach(bomb.yield);
    subjects.push_back({.center = bomb.position + Vec3d{std::cos(angle) * reach, std::sin(angle) * reach, 0}});
  }
}

// How the two planes through the eye that bound the picture along `axis` lie to `subjects`: a point p is inside when
// +-(p - eye) . axis <= slope (eye - p) . back. A ball's radius adds itself, leaned like the plane.
struct Span {
  double high = -std::numeric_limits<double>::infinity();  // eye . axis + slope eye . back must not be below
  double low = -std::numeric_limits<double>::infinity();   // -eye . axis + slope eye . back must not be below
};

Span span_of(const std::vector<Subject>& subjects, const Vec3d& axis, const Vec3d& back, double slope) {
  Span span;
  for (const Subject& s : subjects) {
    const double depth = slope * dot(s.center, back) + s.radius * std::sqrt(1 + slope * slope);
    span.high = std::max(span.high, depth + dot(s.center, axis));
    span.low = std::max(span.low, depth - dot(s.center, axis));
  }
  return span;
}

// Where along `axis` the eye must be, `distance` along `back`, for `subjects` to leave equal room on both sides: the
// narrower the planes stand, the closer the two bounds come, and where they meet they fit tightly.
double centered(const std::vector<Subject>& subjects, const Vec3d& axis, const Vec3d& back, double distance,
                double widest) {
  double narrow = 0, wide = widest;
  for (int halving = 0; halving < 40; ++halving) {
    const double slope = (narrow + wide) / 2;
    const Span span = span_of(subjects, axis, back, slope);
    (span.high + span.low <= 2 * slope * distance ? wide : narrow) = slope;
  }
  const Span span = span_of(subjects, axis, back, wide);
  return (span.high - span.low) / 2;
}

// The eye that sees all of `subjects`: as far away as the stricter screen axis asks for, and in the middle along both.
Camera fit(const std::vector<Subject>& subjects, const Vec3d& center, double aspect, double fill) {
  Camera camera;
  const Vec3d back = {std::sin(kAzimuth) * std::cos(kElevation), -std::cos(kAzimuth) * std::cos(kElevation),
                      std::sin(kElevation)};
  const Vec3d right = unit(cross({0, 0, 1}, back)), up = cross(back, right);
  const double tan_up = std::tan(camera.fov_deg * kDegree / 2) * fill, tan_right = tan_up * aspect;

  const auto demand = [&](const Vec3d& axis, double slope) {
    const Span span = span_of(subjects, axis, back, slope);
    return (span.high + span.low) / (2 * slope);
  };
  const double distance = std::max(demand(right, tan_right), demand(up, tan_up));
  camera.eye = right * centered(subjects, right, back, distance, tan_right) +
               up * centered(subjects, up, back, distance, tan_up) + back * distance;
  // A region without size would put the eye on its target.
  camera.target = camera.eye - back * std::max(distance - dot(center, back), 1.0);
  return camera;
}

}  // namespace

double Region::extent() const { return std::max(max.x - min.x, max.y - min.y); }

Region terrain_bounds(const SurfaceView& surface) {
  Region bounds = empty_region();
  for (const std::uint32_t vertex : surface.triangles) include(bounds, to_double(surface.positions[vertex]), 0);
  if (surface.triangles.empty()) return {.min = surface.origin, .max = surface.origin};
  return {.min = bounds.min + surface.origin, .max = bounds.max + surface.origin};
}

double block_base(const Region& terrain) { return terrain.min.z - kBlock * terrain.extent(); }

namespace {

bool shows_whole_terrain(const Region& events, const Region& terrain, bool only_bodies) {
  const double share = only_bodies ? kWholeTerrainBodies : kWholeTerrain;
  return !(events.extent() > 0) || events.extent() > share * terrain.extent();
}

bool contains(const Region& r, const Vec3d& p) {
  return p.x >= r.min.x && p.x <= r.max.x && p.y >= r.min.y && p.y <= r.max.y;
}

}  // namespace

Framing frame(const SurfaceView& surface, std::span<const BodyView> bodies, std::span<const BombView> bombs,
              double aspect) {
  const Region terrain = terrain_bounds(surface);
  std::vector<Subject> subjects;
  for (const BombView& bomb : bombs) add_crater(bomb, subjects);
  for (const BodyView& body : bodies) {
    if (!body.off_terrain) subjects.push_back({.center = body.position, .radius = kBodyMargin * body.radius});
  }

  Framing framing;
  framing.region = empty_region();
  for (const Subject& s : subjects) include(framing.region, s.center, s.radius);
  const bool whole = shows_whole_terrain(framing.region, terrain, bombs.empty());
  if (whole) {
    framing.region = terrain;
    framing.region.min.z = block_base(terrain);
    add_corners(framing.region, subjects);
    // Where a bomb reaches past the terrain there is nothing to see.
    std::erase_if(subjects, [&](const Subject& s) { return s.radius == 0 && !contains(framing.region, s.center); });
  }
  framing.camera = fit(subjects, framing.region.center(), aspect, whole ? kFillWhole : kFillPart);
  return framing;
}

}  // namespace divot::viewer
