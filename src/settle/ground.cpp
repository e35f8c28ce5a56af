#include "settle/ground.h"

#include <algorithm>

namespace divot::settle {

float bring(Ground& ground, std::uint32_t column, double volume) {
  return bring(ground, column, volume, state::vertex_area(ground.surface, ground.soil.vertex[column]));
}

float bring(Ground& ground, std::uint32_t column, double volume, double area) {
  if (!(area > 0)) return 0;
  state::Soil& soil = ground.soil;
  const std::uint32_t vertex = soil.vertex[column], i = soil.particle[column];
  float& z = ground.surface.position[vertex].z;
  const float before = z;
  z += static_cast<float>(volume / area);
  // Floats far from the origin take coarse steps: the books get what the surface did.
  const float height = z - before;
  const double rose = area * (static_cast<double>(z) - static_cast<double>(before));
  soil.gained[column] += volume;
  soil.compacted[column] += volume - rose;
  soil.rest[column].z += height;
  soil.lift_excess(column, height);
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
