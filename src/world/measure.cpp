#include "world/measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "laws/blast.h"

namespace divot::measure {
namespace {

constexpr double kEdge = 0.05;  // of the depth: where a crater ends
constexpr int kRays = 72;
constexpr double kLeastDepth = 1e-3;  // of a spacing: shallower is no crater

// Sinkage under x, y, m; not a number beside the surface.
double sinkage_at(const state::Surface& surface, const state::Soil& soil, const geometry::Bvh& bvh, Vec3 at,
                  state::RegionScratch& scratch) {
  math::Aabb line;
  line.include(Vec3{at.x, at.y, -math::Aabb::kInf});
  line.include(Vec3{at.x, at.y, math::Aabb::kInf});
  scratch.faces.clear();
  bvh.query(line, scratch.faces);
  for (const std::uint32_t face : scratch.faces) {
    std::array<std::uint32_t, 3> v;
    for (std::uint32_t k = 0; k < 3; ++k) v[k] = surface.mesh.origin(3 * face + k);
    const Vec3 a = surface.position[v[0]], b = surface.position[v[1]], c = surface.position[v[2]];
    const auto side = [&](const Vec3& p, const Vec3& q) {
      return (q.x - p.x) * (at.y - p.y) - (q.y - p.y) * (at.x - p.x);
    };
    const std::array<float, 3> w = {side(b, c), side(c, a), side(a, b)};
    const float total = w[0] + w[1] + w[2];
    if (!(total > 0) || w[0] < 0 || w[1] < 0 || w[2] < 0) continue;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += static_cast<double>(w[k]) * sinkage(surface, soil, v[k]);
    return sum / total;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

struct Ray {
  bool whole = false;  // ends on the surface
  double edge = 0;     // m
  double lip = 0;      // m above the original ground
};

// From ground zero outward to the crater's edge, then on over its lip.
Ray follow(const state::Blast& blast, double angle, double depth, double furthest, const state::Surface& surface,
           const state::Soil& soil, const geometry::Bvh& bvh, state::RegionScratch& scratch) {
  const double stride = 0.1 * surface.spacing;
  const auto sunk = [&](double r) {
    const Vec3 offset{static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle)), 0};
    return sinkage_at(surface, soil, bvh, blast.ground_zero + offset, scratch);
  };
  Ray ray;
  double before = sunk(0), r = stride;
  for (; r <= furthest && !ray.whole; r += stride) {
    const double here = sunk(r);
    if (std::isnan(here)) return {};
    if (here <= kEdge * depth) {
      ray.whole = true;
      const double fall = before - here;
      ray.edge = before <= kEdge * depth ? 0 : r - stride * (kEdge * depth - here) / fall;
    }
    before = here;
  }
  for (; r <= 1.7 * ray.edge; r += stride)
    if (const double here = sunk(r); !std::isnan(here)) ray.lip = std::max(ray.lip, -here);
  return ray;
}

// Integral over a triangle of `area` of the positive part of a function that is linear on it.
double positive_part(double area, std::array<double, 3> f) {
  std::sort(f.begin(), f.end());
  const auto [low, middle, high] = f;
  if (low >= 0) return area * (low + middle + high) / 3;
  if (high <= 0) return 0;
  if (middle <= 0) return area * high * high * high / (3 * (high - low) * (high - middle));
  const double negative = area * -low * low * low / (3 * (low - middle) * (low - high));
  return area * (low + middle + high) / 3 + std::abs(negative);
}

}  // namespace

float sinkage(const state::Surface& surface, const state::Soil& soil, std::uint32_t vertex) {
  const std::uint32_t column = surface.column[vertex];
  return column == kNone ? 0 : soil.original[column].z - surface.position[vertex].z;
}

Crater crater(const state::Blast& blast, const state::Surface& surface, const state::Soil& soil,
              const geometry::Bvh& bvh, state::RegionScratch& scratch) {
  Crater result{.position = to_double(blast.ground_zero) + surface.origin,
                .yield = blast.yield,
                .paper_width = laws::crater_width(blast.yield)};
  double depth = 0;
  for (const std::uint32_t column : blast.column)
    depth = std::max<double>(depth, sinkage(surface, soil, soil.vertex[column]));
  if (depth < kLeastDepth * surface.spacing) return result;

  double radius = 0, lip = 0;
  int rays = 0;
  for (int k = 0; k < kRays; ++k) {
    const Ray ray =
        follow(blast, 2 * std::numbers::pi * k / kRays, depth, 2 * result.paper_width, surface, soil, bvh, scratch);
    if (ray.whole) radius += ray.edge, lip += ray.lip, ++rays;
  }
  if (rays == 0 || radius == 0) return result;
  result.depth = depth;
  result.width = 2 * radius / rays;
  result.lip_height = lip / rays;
  for (std::size_t c = 0; c < soil.size(); ++c) {
    const Vec3 offset = soil.original[c] - blast.ground_zero;
    if (std::hypot(offset.x, offset.y) > 1.5 * result.width) continue;
    result.volume += std::max(0.0f, sinkage(surface, soil, soil.vertex[c])) * soil.area[c];
  }
  return result;
}

SoilVolume soil_volume(const state::Surface& surface, const state::Soil& soil) {
  SoilVolume volume;
  std::vector<std::uint32_t> faces;
  for (std::size_t c = 0; c < soil.size(); ++c) {
    volume.compacted += static_cast<double>(soil.compacted(static_cast<std::uint32_t>(c))) * soil.area[c];
    surface.mesh.for_each_face(soil.vertex[c], [&](std::uint32_t face) { faces.push_back(face); });
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  for (const std::uint32_t face : faces) {
    std::array<double, 3> sunk, raised;
    std::array<Vec3, 3> p;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t v = surface.mesh.origin(3 * face + k);
      p[k] = surface.position[v];
      sunk[k] = sinkage(surface, soil, v);
      raised[k] = -sunk[k];
    }
    const Vec3 a = p[1] - p[0], b = p[2] - p[0];
    const double area = 0.5 * (static_cast<double>(a.x) * b.y - static_cast<double>(a.y) * b.x);
    volume.displaced += positive_part(area, sunk);
    volume.deposited += positive_part(area, raised);
  }
  return volume;
}

}  // namespace divot::measure
