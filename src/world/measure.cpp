#include "world/measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "laws/bekker.h"
#include "laws/blast.h"

namespace divot::measure {
namespace {

constexpr double kEdge = 0.05;  // of the depth: where a crater ends
constexpr int kRays = 72;
constexpr double kLeastDepth = 1e-3;  // of a spacing: shallower is no crater
constexpr int kCuts = 4;              // of each edge of a face that was dragged sideways, for the balance of soil
constexpr int kLongestWalk = 200;     // faces between where a vertex was and where it is

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

Vec3d original(const state::Surface& surface, const state::Soil& soil, std::uint32_t vertex) {
  const std::uint32_t column = surface.column[vertex];
  return to_double(column == kNone ? surface.position[vertex] : soil.original[column]);
}

// Height over x, y of the ground as it was before the first touch. Walks from `face`, as it was, to the one that holds
// the point.
double original_height(const state::Surface& surface, const state::Soil& soil, std::uint32_t face, const Vec3d& at) {
  double height = at.z;
  for (int step = 0; step < kLongestWalk; ++step) {
    std::array<Vec3d, 3> p;
    for (std::uint32_t k = 0; k < 3; ++k) p[k] = original(surface, soil, surface.mesh.origin(3 * face + k));
    std::array<double, 3> w;  // of the corner opposite each edge
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Vec3d &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
      w[k] = (b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x);
    }
    const double total = w[0] + w[1] + w[2];
    if (!(total > 0)) break;
    height = (w[0] * p[0].z + w[1] * p[1].z + w[2] * p[2].z) / total;
    const auto k = static_cast<std::uint32_t>(std::min_element(w.begin(), w.end()) - w.begin());
    if (w[k] >= 0) break;
    const std::uint32_t across = surface.mesh.twin(3 * face + (k + 1) % 3);
    if (across == kNone) break;  // it was dragged over the border: the last face goes on
    face = geometry::HalfEdgeMesh::face_of(across);
  }
  return height;
}

// Was a corner of the face dragged sideways from where it stood, as by a blast on a slope?
bool was_dragged(const state::Surface& surface, const state::Soil& soil, std::uint32_t face) {
  for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h) {
    const Vec3d now = to_double(surface.position[surface.mesh.origin(h)]);
    const Vec3d then = original(surface, soil, surface.mesh.origin(h));
    if (now.x != then.x || now.y != then.y) return true;
  }
  return false;
}

// Adds what lies between a face and the original ground. Where its corners are still in their places, both are planes
// and the integral is exact; a face that was dragged lies over edges of the original ground and is cut small.
void add_face(const state::Surface& surface, const state::Soil& soil, std::uint32_t face, SoilVolume& volume) {
  const int cuts = was_dragged(surface, soil, face) ? kCuts : 1;
  std::array<Vec3d, 3> p;
  for (std::uint32_t k = 0; k < 3; ++k) p[k] = to_double(surface.position[surface.mesh.origin(3 * face + k)]);
  const Vec3d a = (p[1] - p[0]) * (1.0 / cuts), b = (p[2] - p[0]) * (1.0 / cuts);
  const double area = 0.5 * (a.x * b.y - a.y * b.x);
  const auto sunk_at = [&](int i, int j) {
    const Vec3d at = p[0] + i * a + j * b;
    return original_height(surface, soil, face, at) - at.z;
  };
  const auto add = [&](double f, double g, double h) {
    volume.displaced += positive_part(area, {f, g, h});
    volume.deposited += positive_part(area, {-f, -g, -h});
  };
  for (int i = 0; i < cuts; ++i)
    for (int j = 0; i + j < cuts; ++j) {
      const double right = sunk_at(i + 1, j), left = sunk_at(i, j + 1);
      add(sunk_at(i, j), right, left);
      if (i + j + 1 < cuts) add(right, sunk_at(i + 1, j + 1), left);
    }
}

}  // namespace

float sinkage(const state::Surface& surface, const state::Soil& soil, std::uint32_t vertex) {
  const std::uint32_t column = surface.column[vertex];
  return column == kNone ? 0 : soil.original[column].z - surface.position[vertex].z;
}

float pressure(const state::Surface& surface, const state::Soil& soil, std::span<const laws::Medium> media,
               std::uint32_t vertex) {
  const std::uint32_t column = surface.column[vertex];
  if (column == kNone || soil.particle[column] == kNone) return 0;
  const laws::Medium& medium = media[surface.material[vertex]];
  if (!medium.ground) return 0;
  constexpr float kWide = std::numeric_limits<float>::infinity();
  const float sunk = soil.rest[column].z - surface.position[vertex].z, plastic = soil.plastic[column];
  return laws::ground_pressure(medium, plastic + sunk, plastic, kWide, medium.elastic_stiffness).value;
}

Energy energy(std::span<const state::Body> bodies, const state::Particles& particles, const Vec3d& gravity,
              const Vec3d& origin) {
  Energy sum;
  for (const state::Body& b : bodies) {
    sum.bodies_kinetic +=
        0.5 * (b.mass * dot(b.velocity, b.velocity) + b.inertia * dot(b.angular_velocity, b.angular_velocity));
    sum.bodies_potential -= b.mass * dot(gravity, b.position + origin);
  }
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.hold[i] == Hold::anchor) continue;
    const Vec3d v = to_double(particles.velocity(i));
    sum.ground_kinetic += 0.5 * particles.mass[i] * dot(v, v);
  }
  return sum;
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
    volume.compacted += soil.compacted[c];
    surface.mesh.for_each_face(soil.vertex[c], [&](std::uint32_t face) { faces.push_back(face); });
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  for (const std::uint32_t face : faces) add_face(surface, soil, face, volume);
  return volume;
}

}  // namespace divot::measure
