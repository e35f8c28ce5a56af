#include "settle/ground.h"

#include <algorithm>

namespace divot::settle {

double move_vertex(state::Surface& surface, std::uint32_t vertex, const Vec3& to) {
  // Each face sweeps a tetrahedron: the triple product of the vertex's way and the face's other two edges.
  const Vec3d from = to_double(surface.position[vertex]);
  Vec3d area;
  surface.mesh.for_each_outgoing(vertex, [&](std::uint32_t h) {
    const Vec3d a = to_double(surface.position[surface.mesh.target(h)]) - from;
    const Vec3d b = to_double(surface.position[surface.mesh.origin(geometry::HalfEdgeMesh::prev(h))]) - from;
    area += cross(a, b);
  });
  surface.position[vertex] = to;
  return dot(from - to_double(to), area) / 6;
}

float bring(Ground& ground, std::uint32_t column, double volume) {
  state::Soil& soil = ground.soil;
  const std::uint32_t vertex = soil.vertex[column], i = soil.particle[column];
  const float area = state::vertex_area(ground.surface, vertex);
  if (!(area > 0)) return 0;
  Vec3 place = ground.surface.position[vertex];
  const float before = place.z;
  place.z += static_cast<float>(volume) / area;
  // Floats far from the origin take coarse steps: the books get what the surface did.
  const double rose = -move_vertex(ground.surface, vertex, place);
  const float height = place.z - before;
  soil.gained[column] += volume;
  soil.compacted[column] += volume - rose;
  soil.rest[column].z += height;
  const float loose = std::max(0.0f, soil.loose[column] + height), more = loose - soil.loose[column];
  soil.loose[column] = loose;
  // Loose soil bears nothing: Bekker's curve goes on where it was left once what lies on top is pressed away.
  float& plastic = soil.plastic[column];
  plastic = more > 0 ? plastic - more : std::max(plastic, std::min(0.0f, plastic - more));
  if (i != kNone) ground.particles.z[i] += height;
  ground.moved.vertices.push_back(vertex);
  return height;
}

}  // namespace divot::settle
