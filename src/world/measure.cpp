#include "world/measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "laws/bekker.h"

namespace divot::measure {
namespace {

constexpr int kCuts = 4;           // of each edge of a face that was dragged sideways, for the balance of soil
constexpr int kLongestWalk = 200;  // faces between where a vertex was and where it is

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
    const Vec3d spin = math::rotate(math::conjugate(b.orientation), b.angular_velocity);
    const Vec3d squares{spin.x * spin.x, spin.y * spin.y, spin.z * spin.z};
    sum.bodies_kinetic += 0.5 * (b.mass * dot(b.velocity, b.velocity) + dot(b.inertia, squares));
    sum.bodies_potential -= b.mass * dot(gravity, b.position + origin);
  }
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.hold[i] == Hold::anchor) continue;
    const Vec3d v = to_double(particles.velocity(i));
    sum.ground_kinetic += 0.5 * particles.mass[i] * dot(v, v);
  }
  return sum;
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
