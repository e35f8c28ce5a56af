#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "laws/blast.h"
#include "world/measure.h"

namespace divot::measure {
namespace {

constexpr double kEdge = 0.05;  // of the depth: where a crater ends
constexpr int kRays = 72;
constexpr double kLeastDepth = 1e-3;  // of a spacing: shallower is no crater
constexpr double kLipEnd = 2.5;       // crater radii: soil further out belongs to no lip
// A ray whose edge lies further out than this, in radii of the ground that failed, has run into another crater.
constexpr double kOwn = 1.35;

// Sinkage of the ground that a place belongs to, m; not a number beside the surface.
double sinkage_at(const state::Surface& surface, const state::Soil& soil, const geometry::Bvh& bvh, const Vec3& at,
                  state::RegionScratch& scratch) {
  const state::SurfacePoint point = state::surface_at(surface, bvh, at, scratch);
  if (!point.found) return std::numeric_limits<double>::quiet_NaN();
  const auto corner = [&](std::uint32_t k) {
    return to_double(surface.position[surface.mesh.origin(3 * point.face + k)]);
  };
  const Vec3d a = corner(0), across = cross(corner(1) - a, corner(2) - a);
  const double height = a.z - (across.x * (at.x - a.x) + across.y * (at.y - a.y)) / across.z;
  return original_height(surface, soil, point.face, {at.x, at.y, height}) - height;
}

/// A profile from ground zero outward.
struct Ray {
  double stride = 0;         // m
  std::vector<double> sunk;  // m, at multiples of the stride; ends where the surface does
  double edge = 0;           // m, 0 where it found none

  // Where sinkage first falls to 5 % of the depth, no further out than `furthest`.
  void find_edge(double depth, double furthest) {
    const double level = kEdge * depth;
    for (std::size_t k = 1; k < sunk.size() && static_cast<double>(k - 1) * stride <= furthest; ++k) {
      if (sunk[k] > level) continue;
      const double fall = sunk[k - 1] - sunk[k];
      const double part = sunk[k - 1] <= level ? 0 : (sunk[k - 1] - level) / fall;
      edge = (static_cast<double>(k - 1) + part) * stride;
      return;
    }
  }
  // Soil below (sign 1) or above (sign -1) the original ground from one radius to another, m^3 for each radian.
  double volume(double from, double to, double sign) const {
    double sum = 0;
    for (std::size_t k = 0; k < sunk.size(); ++k) {
      const double r = static_cast<double>(k) * stride;
      if (r >= from && r < to) sum += std::max(0.0, sign * sunk[k]) * r * stride;
    }
    return sum;
  }
  double lip(double from, double to) const {
    double highest = 0;
    for (std::size_t k = 0; k < sunk.size(); ++k) {
      const double r = static_cast<double>(k) * stride;
      if (r >= from && r <= to) highest = std::max(highest, -sunk[k]);
    }
    return highest;
  }
};

std::vector<Ray> cast_rays(const state::Blast& blast, double reach, const state::Surface& surface,
                           const state::Soil& soil, const geometry::Bvh& bvh, state::RegionScratch& scratch) {
  std::vector<Ray> rays(kRays);
  for (int k = 0; k < kRays; ++k) {
    Ray& ray = rays[static_cast<std::size_t>(k)];
    ray.stride = std::max(0.1 * surface.spacing, reach / 500);
    const double angle = 2 * std::numbers::pi * k / kRays, x = std::cos(angle), y = std::sin(angle);
    for (double r = 0; r <= reach; r = static_cast<double>(ray.sunk.size()) * ray.stride) {
      const Vec3 offset{static_cast<float>(r * x), static_cast<float>(r * y), 0};
      const double sunk = sinkage_at(surface, soil, bvh, blast.ground_zero + offset, scratch);
      if (std::isnan(sunk)) break;
      ray.sunk.push_back(sunk);
    }
  }
  return rays;
}

// Mean of the edges that rays found; 0 when none did.
double mean_edge(const std::vector<Ray>& rays) {
  double sum = 0;
  int found = 0;
  for (const Ray& ray : rays)
    if (ray.edge > 0) sum += ray.edge, ++found;
  return found > 0 ? sum / found : 0;
}

}  // namespace

Crater crater(const state::Blast& blast, const state::Surface& surface, const state::Soil& soil,
              const geometry::Bvh& bvh, state::RegionScratch& scratch) {
  Crater result{.position = to_double(blast.ground_zero) + surface.origin,
                .yield = blast.yield,
                .paper_width = laws::crater_width(blast.yield)};
  double depth = 0;
  for (const std::uint32_t column : blast.column)
    depth = std::max<double>(depth, sinkage(surface, soil, soil.vertex[column]));
  if (depth < kLeastDepth * surface.spacing) return result;

  // Its own edge; where others have swallowed it, theirs.
  const double reach = 3 * kOwn * blast.radius;
  std::vector<Ray> rays = cast_rays(blast, reach, surface, soil, bvh, scratch);
  for (Ray& ray : rays) ray.find_edge(depth, kOwn * blast.radius + surface.spacing);
  if (mean_edge(rays) == 0)
    for (Ray& ray : rays) ray.find_edge(depth, reach);
  const double radius = mean_edge(rays);
  if (radius == 0) return result;

  result.depth = depth;
  result.width = 2 * radius;
  int lips = 0;
  for (const Ray& ray : rays) {
    constexpr double kAngle = 2 * std::numbers::pi / kRays;
    const double edge = ray.edge > 0 ? ray.edge : radius;
    result.volume += kAngle * ray.volume(0, edge, 1);
    result.lip_volume += kAngle * ray.volume(edge, kLipEnd * edge, -1);
    if (ray.edge > 0) result.lip_height += ray.lip(edge, 1.7 * edge), ++lips;
  }
  result.lip_height /= lips;
  return result;
}

}  // namespace divot::measure
