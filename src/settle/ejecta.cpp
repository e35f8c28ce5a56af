#include "settle/ejecta.h"

#include <algorithm>

namespace divot::settle {

double throw_soil(const state::Blast& blast, const state::Particles& p, std::span<float> lost, state::Soil& soil) {
  double volume = 0;
  if (blast.landing.empty()) return volume;
  for (std::size_t k = 0; k < blast.column.size(); ++k) {
    const std::uint32_t column = blast.column[k], i = soil.particle[column];
    if (i == kNone || p.flow_rate[i] == 0) continue;
    // What one blast throws is no longer there for the next to throw.
    const double thrown = static_cast<double>(blast.thrown[k]) * std::max(0.0f, lost[i]);
    lost[i] -= static_cast<float>(thrown);
    soil.gained[column] -= thrown;
    soil.compacted[column] -= thrown;
    volume += thrown;
  }
  return volume;
}

float land_soil(const state::Blast& blast, double volume, Ground& ground) {
  float highest = 0;
  for (std::size_t k = 0; k < blast.landing.size(); ++k) {
    const std::uint32_t column = blast.landing[k];
    const double share = static_cast<double>(blast.landing_height[k]) * ground.soil.area[column];
    highest = std::max(highest, bring(ground, column, volume * share));
  }
  return highest;
}

}  // namespace divot::settle
