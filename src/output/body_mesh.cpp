#include "output/body_mesh.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "math/quat.h"

namespace divot::output {
namespace {

constexpr std::uint32_t kSegments = 32;  // around what is round: so many that its outline looks round
constexpr int kRings = 8;                // from the equator of a ball to its pole

using OutlinePoint = std::pair<double, double>;  // distance from the axis, place along it, m

// Turns an outline, from its lowest point to its highest, about z.
BodyMesh turned(const std::vector<OutlinePoint>& outline) {
  BodyMesh mesh;
  for (std::uint32_t i = 0; i < outline.size(); ++i) {
    const auto [radius, z] = outline[i];
    for (std::uint32_t j = 0; j < kSegments; ++j) {
      const double angle = 2 * std::numbers::pi * j / kSegments;
      mesh.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
      if (i + 1 == outline.size()) continue;
      const std::uint32_t here = i * kSegments + j, next = i * kSegments + (j + 1) % kSegments;
      mesh.triangles.insert(mesh.triangles.end(),
                            {here, next, next + kSegments, here, next + kSegments, here + kSegments});
    }
  }
  return mesh;
}

// From z, about which outlines turn, to y: x, y, z become z, x, y, which is a rotation.
BodyMesh lying(BodyMesh mesh) {
  for (Vec3d& p : mesh.vertices) p = {p.y, p.z, p.x};
  return mesh;
}

// Of a ball about (0, middle), from ring `first` to ring `last`: -kRings is the lowest point, kRings the highest.
void add_arc(std::vector<OutlinePoint>& outline, double radius, double middle, int first, int last) {
  for (int k = first; k <= last; ++k) {
    const double angle = std::numbers::pi / 2 * k / kRings;
    outline.emplace_back(radius * std::cos(angle), middle + radius * std::sin(angle));
  }
}

BodyMesh make(const Sphere& ball) {
  std::vector<OutlinePoint> outline;
  add_arc(outline, ball.radius, 0, -kRings, kRings);
  return turned(outline);
}

BodyMesh make(const Box& box) {
  BodyMesh mesh;
  for (const double z : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double x : {-0.5, 0.5}) mesh.vertices.push_back({x * box.size.x, y * box.size.y, z * box.size.z});
  mesh.triangles = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  return mesh;
}

BodyMesh make(const Cylinder& c) {
  const double half = c.length / 2;
  return lying(turned({{0, -half}, {c.radius, -half}, {c.radius, half}, {0, half}}));
}

BodyMesh make(const Capsule& c) {
  std::vector<OutlinePoint> outline;
  add_arc(outline, c.radius, -c.length / 2, -kRings, 0);
  add_arc(outline, c.radius, c.length / 2, 0, kRings);
  return lying(turned(outline));
}

BodyMesh make(const Cone& cone) {
  return turned({{0, -cone.height / 2}, {cone.radius, -cone.height / 2}, {0, cone.height / 2}});
}

BodyMesh make(const Hull& hull) { return {hull.points, hull.triangles}; }

BodyMesh make(const Compound& compound) {
  BodyMesh mesh;
  for (const Part& part : compound.parts) {
    const BodyMesh piece = std::visit([](const auto& shape) { return make(shape); }, part.shape);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const Quat turn = rotation(part.rotation_deg);
    for (const Vec3d& p : piece.vertices) mesh.vertices.push_back(part.position + math::rotate(turn, p));
    for (const std::uint32_t corner : piece.triangles) mesh.triangles.push_back(first + corner);
  }
  return mesh;
}

}  // namespace

BodyMesh body_mesh(const Shape& shape) {
  return std::visit([](const auto& s) { return make(s); }, shape);
}

}  // namespace divot::output
