#include "settle/settle.h"

#include <algorithm>
#include <iterator>

#include "settle/ejecta.h"

namespace divot::settle {
namespace {

void throw_and_land(const std::vector<state::Blast>& blasts, std::span<float> lost, Ground& ground) {
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

// Puts to sleep what has been still for long enough.
void fall_asleep(const Stillness& stillness, state::Particles& p, state::Soil& soil) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (p.hold[i] != Hold::free || p.still_steps[i] < stillness.steps) continue;
    p.hold[i] = Hold::asleep;
    p.flow_rate[i] = 0;
    p.set_velocity(i, {});
    hand_over(p, i, soil);
    soil.restless.push_back(p.vertex[i]);
  }
}

// Sorts what came to a list after its first `ascending` numbers, which are in order, into them.
void merge_tail(std::vector<std::uint32_t>& list, std::size_t ascending, Scratch& scratch) {
  if (list.size() == ascending) return;
  const auto middle = list.begin() + static_cast<std::ptrdiff_t>(ascending);
  scratch.tail.assign(middle, list.end());
  scratch.set.sort_unique(scratch.tail);
  scratch.merged.clear();
  std::set_union(list.begin(), middle, scratch.tail.begin(), scratch.tail.end(), std::back_inserter(scratch.merged));
  list.swap(scratch.merged);
}

}  // namespace

void update(state::Particles& p, state::Soil& soil, state::Surface& surface, std::vector<state::Blast>& blasts,
            std::span<const state::Body> bodies, std::span<const laws::Medium> media, const Stillness& stillness,
            const Step& step, bool particles_changed, Moved& moved, Scratch& scratch, const Jobs& jobs) {
  moved.vertices.clear();
  Ground ground{p, soil, surface, moved};
  follow(stillness, particles_changed, ground, scratch.follow, jobs);
  const std::size_t followed = moved.vertices.size();
  throw_and_land(blasts, scratch.follow.lost, ground);
  flow_aside(bodies, media, step, ground, scratch.flow);

  const auto brought = moved.vertices.begin() + static_cast<std::ptrdiff_t>(followed);
  soil.restless.insert(soil.restless.end(), brought, moved.vertices.end());
  add_restless(sliding_slopes(media, step.gravity), ground, scratch.follow, jobs, soil.restless);
  if (scratch.follow.sleepy) fall_asleep(stillness, p, soil);
  scratch.set.sort_unique(soil.restless);
  slump(ground, bodies, media, step.gravity, step.dt, scratch.slump, jobs);
  merge_tail(moved.vertices, followed, scratch);
  for (state::Blast& blast : blasts) blast.active = blast.active && still_acts(blast, p, soil, step.time);
}

}  // namespace divot::settle
