#include "settle/settle.h"

#include <algorithm>
#include <cmath>

#include "settle/ejecta.h"

namespace divot::settle {
namespace {

// Moves the surface with its particles and counts for how long each has been still: by its speed, or because it has not
// come further than that speed would bring it. Far from the origin a creep can be too slow for a float to take a step.
// What the ground loses by that has become denser; whatever goes elsewhere instead is taken from it later.
void move_surface(const Stillness& stillness, Ground& ground, std::vector<double>& lost) {
  state::Particles& p = ground.particles;
  Moved& moved = ground.moved;
  lost.assign(p.size(), 0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.hold[i] == Hold::anchor) continue;
    const std::uint32_t vertex = p.vertex[i];
    const Vec3 place = ground.surface.position[vertex];
    // The border of the terrain, and of holes in it, stays where it is on the map.
    if (ground.surface.mesh.is_boundary(vertex)) p.x[i] = place.x, p.y[i] = place.y;
    const float step = length(p.position(i) - place);
    const bool still = length(p.velocity(i)) < stillness.speed || step < stillness.step;
    p.still_steps[i] = still ? static_cast<std::uint16_t>(std::min(p.still_steps[i] + 1, 0xffff)) : std::uint16_t{0};
    if (step == 0) continue;
    lost[i] = move_vertex(ground.surface, vertex, p.position(i));
    ground.soil.compacted[p.column[i]] += lost[i];
    // A blast loosens what it makes flow; any other load packs what lay loose.
    float& loose = ground.soil.loose[p.column[i]];
    const float sunk = place.z - p.z[i];
    loose = std::max(0.0f, p.flow_rate[i] > 0 ? loose + std::abs(sunk) : loose - std::max(0.0f, sunk));
    moved.vertices.push_back(vertex);
    moved.distance = std::max(moved.distance, step);
    if (p.hold[i] == Hold::free) moved.free_distance = std::max(moved.free_distance, step);
  }
}

void throw_and_land(const std::vector<state::Blast>& blasts, std::span<double> lost, Ground& ground) {
  for (const state::Blast& blast : blasts) {
    if (!blast.active) continue;
    const double thrown = throw_soil(blast, ground.particles, lost, ground.soil);
    if (thrown <= 0) continue;
    const float rose = land_soil(blast, thrown, ground);
    ground.moved.distance += rose, ground.moved.free_distance += rose;
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
  // Only loose soil bears nothing; ground that was pulled up stands as it is.
  soil.plastic[column] = std::max(-soil.loose[column], soil.fresh_height(column) - p.z[i]);
  soil.rest[column] = p.position(i);
}

}  // namespace

void update(state::Particles& p, state::Soil& soil, state::Surface& surface, std::vector<state::Blast>& blasts,
            std::span<const state::Body> bodies, std::span<const laws::Medium> media, const Stillness& stillness,
            const Step& step, Moved& moved, Scratch& scratch, const Jobs& jobs) {
  moved.vertices.clear();
  moved.distance = moved.free_distance = 0;
  Ground ground{p, soil, surface, moved};
  move_surface(stillness, ground, scratch.lost);
  throw_and_land(blasts, scratch.lost, ground);
  flow_aside(bodies, media, step, ground, scratch.flow);

  soil.restless.insert(soil.restless.end(), moved.vertices.begin(), moved.vertices.end());
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.hold[i] != Hold::free) continue;
    if (p.still_steps[i] < stillness.steps) continue;
    p.hold[i] = Hold::asleep;
    p.flow_rate[i] = 0;
    p.set_velocity(i, {});
    hand_over(p, i, soil);
    soil.restless.push_back(p.vertex[i]);
  }
  scratch.set.sort_unique(soil.restless);
  slump(ground, media, step.gravity, step.dt, scratch.slump, jobs);
  scratch.set.sort_unique(moved.vertices);
  for (state::Blast& blast : blasts) blast.active = blast.active && still_acts(blast, p, soil, step.time);
}

}  // namespace divot::settle
