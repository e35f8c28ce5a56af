#include "settle/ejecta.h"

#include <algorithm>

namespace divot::settle {

double throw_soil(const state::Blast& blast, const state::Particles& p, const state::Surface& surface,
                  state::Soil& soil, std::span<const laws::Medium> media) {
  double volume = 0;
  if (blast.landing.empty()) return volume;
  for (const std::uint32_t column : blast.column) {
    const std::uint32_t i = soil.particle[column];
    if (i == kNone || p.flow_rate[i] == 0) continue;
    const float sunk = std::max(0.0f, surface.position[soil.vertex[column]].z - p.z[i]);
    const float thrown = media[p.material[i]].ejecta_share * sunk;
    soil.added[column] -= thrown;
    volume += thrown * soil.area[column];
  }
  return volume;
}

void land_soil(const state::Blast& blast, float volume, state::Particles& p, state::Surface& surface, state::Soil& soil,
               Moved& moved) {
  for (std::size_t k = 0; k < blast.landing.size(); ++k) {
    const std::uint32_t column = blast.landing[k], i = soil.particle[column];
    const float height = volume * blast.landing_height[k];
    soil.added[column] += height;
    soil.rest[column].z += height;
    if (i != kNone) p.z[i] += height;
    if (i != kNone && p.hold[i] != Hold::anchor) continue;  // its surface follows below
    surface.position[soil.vertex[column]].z += height;
    moved.vertices.push_back(soil.vertex[column]);
    moved.distance = std::max(moved.distance, height);
    moved.free_distance = std::max(moved.free_distance, height);
  }
}

}  // namespace divot::settle
