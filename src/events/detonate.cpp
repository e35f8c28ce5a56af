#include <algorithm>
#include <cmath>

#include "events/events.h"
#include "events/scaled_blast.h"
#include "events/targets.h"
#include "laws/blast.h"

namespace divot::events {
namespace {

// The paper's model: eq. 14 on the particles inside the crater width.
void push_paper(const Bomb& bomb, double height, state::Blast& blast, state::Surface& surface, state::Soil& soil,
                const geometry::Bvh& bvh, state::RegionScratch& scratch) {
  const double radius = laws::crater_width(bomb.yield) / 2;
  blast.radius = radius;
  const laws::Source source = laws::paper_source(bomb.yield, height);
  blast.direction = into_ground(surface, targets(blast, radius, surface, bvh, scratch));
  for (const Target& t : targets(blast, radius, surface, bvh, scratch)) {
    const double x = source.distance(t.radius, t.above);
    blast.column.push_back(state::touch_column(surface, soil, t.vertex));
    blast.thrown.push_back(0);
    blast.push.push_back(static_cast<float>(laws::paper_push(source, x, std::max(0.0, (source.height - t.above) / x))));
  }
}

}  // namespace

state::Blast detonate(const Bomb& bomb, Blast model, const Moment& moment, std::span<state::Blast> earlier,
                      state::Surface& surface, state::Soil& soil, const geometry::Bvh& bvh,
                      std::span<const laws::Medium> media, state::RegionScratch& scratch) {
  // A pulse much shorter than the step is stretched to what the substeps can follow: the scaled crater does not depend
  // on it.
  state::Blast blast{.direction = {0, 0, -1},
                     .yield = bomb.yield,
                     .start = moment.time,
                     .pulse = std::max(laws::pulse(bomb.yield), moment.dt / 8)};
  const Vec3 burst = to_float(bomb.position - surface.origin);
  const state::SurfacePoint ground = state::surface_at(surface, bvh, burst, scratch);
  blast.ground_zero = ground.found ? ground.position : burst;
  blast.active = ground.found;
  if (!ground.found) return blast;  // beside the terrain, or over a hole
  const double height = burst.z - ground.position.z;
  if (model == Blast::scaled)
    push_scaled({bomb.yield, height, moment.gravity}, blast, earlier, surface, soil, bvh, media, scratch);
  else
    push_paper(bomb, std::max(0.0, height), blast, surface, soil, bvh, scratch);
  blast.active = !blast.column.empty();
  return blast;
}

void loosen(const state::Blast& blast, const state::Soil& soil, state::Particles& particles) {
  for (const std::uint32_t column : blast.column) {
    const std::uint32_t i = soil.particle[column];
    if (i == kNone || particles.hold[i] == Hold::anchor) continue;
    // A body on top does not hold the ground against a blast; it meets it again in the next step, or falls after it.
    if (particles.hold[i] == Hold::carried) particles.set_velocity(i, {});
    particles.hold[i] = Hold::free;
    particles.flow_rate[i] = std::max(particles.flow_rate[i], blast.flow_rate);
  }
}

}  // namespace divot::events
