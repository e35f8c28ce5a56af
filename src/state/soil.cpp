#include "state/soil.h"

namespace divot::state {

double vertex_area(const Surface& surface, std::uint32_t vertex) {
  double sum = 0;
  const Vec3d p = to_double(surface.position[vertex]);
  surface.mesh.for_each_outgoing(vertex, [&](std::uint32_t h) {
    const Vec3d a = to_double(surface.position[surface.mesh.target(h)]) - p;
    const Vec3d b = to_double(surface.position[surface.mesh.origin(geometry::HalfEdgeMesh::prev(h))]) - p;
    sum += a.x * b.y - a.y * b.x;
  });
  return sum / 6;
}

namespace {

// `place(vertex)`, m.
template <class Place>
float cell_area_of(const geometry::HalfEdgeMesh& mesh, std::uint32_t vertex, Place place) {
  float sum = 0;
  const Vec3 p = place(vertex);
  mesh.for_each_outgoing(vertex, [&](std::uint32_t h) {
    const Vec3 a = place(mesh.target(h)) - p;
    const Vec3 b = place(mesh.origin(geometry::HalfEdgeMesh::prev(h))) - p;
    const float twice = a.x * b.y - a.y * b.x, aa = a.x * a.x + a.y * a.y, bb = b.x * b.x + b.y * b.y,
                ab = a.x * b.x + a.y * b.y;
    if (!(twice > 0)) return;
    const float at_a = aa - ab, at_b = bb - ab;  // each corner's cosine times its sides
    if (ab < 0)
      sum += twice / 4;
    else if (at_a < 0 || at_b < 0)
      sum += twice / 8;
    else
      sum += (aa * at_b + bb * at_a) / (8 * twice);  // each half edge times its distance from the circle's centre
  });
  return sum;
}

}  // namespace

float cell_area(const Surface& surface, std::uint32_t vertex) {
  return cell_area_of(surface.mesh, vertex, [&](std::uint32_t v) { return surface.position[v]; });
}

float cell_area_before(const Surface& surface, const Soil& soil, std::uint32_t vertex) {
  return cell_area_of(surface.mesh, vertex, [&](std::uint32_t v) { return original_place(surface, soil, v); });
}

std::uint32_t touch_column(Surface& surface, Soil& soil, std::uint32_t vertex) {
  std::uint32_t& column = surface.column[vertex];
  if (column != kNone) return column;
  column = static_cast<std::uint32_t>(soil.size());
  soil.vertex.push_back(vertex);
  soil.particle.push_back(kNone);
  soil.original.push_back(surface.position[vertex]);
  soil.rest.push_back(surface.position[vertex]);
  soil.plastic.push_back(0);
  soil.shear.push_back({});
  soil.area.push_back(static_cast<float>(vertex_area(surface, vertex)));
  soil.cell.push_back(cell_area(surface, vertex));
  soil.gained.push_back(0);
  soil.compacted.push_back(0);
  soil.loose.push_back(0);
  soil.excess.push_back(0);
  return column;
}

}  // namespace divot::state
