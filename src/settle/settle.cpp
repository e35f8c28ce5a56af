#include "settle/settle.h"

#include <algorithm>
#include <cmath>

#include "settle/ejecta.h"

namespace divot::settle {
namespace {

// Moves the surface with its particles and counts for how long each has been still: by its speed, or because it has not
// come further than that speed would bring it. Far from the origin a creep can be too slow for a float to take a step.
void move_surface(state::Particles& p, state::Surface& surface, const Stillness& stillness, Moved& moved) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.hold[i] == Hold::anchor) continue;
    Vec3& place = surface.position[p.vertex[i]];
    const float step = length(p.position(i) - place);
    const bool still = length(p.velocity(i)) < stillness.speed || step < stillness.step;
    p.still_steps[i] = still ? static_cast<std::uint16_t>(std::min(p.still_steps[i] + 1, 0xffff)) : std::uint16_t{0};
    if (step == 0) continue;
    place = p.position(i);
    moved.vertices.push_back(p.vertex[i]);
    moved.distance = std::max(moved.distance, step);
    if (p.hold[i] == Hold::free) moved.free_distance = std::max(moved.free_distance, step);
  }
}

// A blast is over when its pulse is and what it pushed has come to rest.
bool still_acts(const state::Blast& blast, const state::Particles& p, const state::Soil& soil, double time) {
  if (time < blast.start + blast.pulse) return true;
  return std::any_of(blast.column.begin(), blast.column.end(), [&](std::uint32_t column) {
    const std::uint32_t i = soil.particle[column];
    return i != kNone && p.hold[i] == Hold::free;
  });
}

// For good: what is elastic is given up.
void hand_over(const state::Particles& p, std::size_t i, state::Soil& soil) {
  const std::uint32_t column = p.column[i];
  soil.plastic[column] = std::max(0.0f, soil.fresh_height(column) - p.z[i]);
  soil.rest[column] = p.position(i);
}

}  // namespace

void update(state::Particles& p, state::Soil& soil, state::Surface& surface, std::vector<state::Blast>& blasts,
            std::span<const laws::Medium> media, const Stillness& stillness, double time, Moved& moved) {
  moved.vertices.clear();
  moved.distance = moved.free_distance = 0;
  for (state::Blast& blast : blasts) {
    if (!blast.active) continue;
    const double thrown = throw_soil(blast, p, surface, soil, media);
    if (thrown > 0) land_soil(blast, static_cast<float>(thrown), p, surface, soil, moved);
  }
  move_surface(p, surface, stillness, moved);

  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.hold[i] != Hold::free) continue;
    if (p.still_steps[i] < stillness.steps) continue;
    p.hold[i] = Hold::asleep;
    p.flow_rate[i] = 0;
    p.set_velocity(i, {});
    hand_over(p, i, soil);
  }
  for (state::Blast& blast : blasts) blast.active = blast.active && still_acts(blast, p, soil, time);
}

}  // namespace divot::settle
