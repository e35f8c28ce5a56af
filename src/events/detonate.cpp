#include <algorithm>
#include <cmath>

#include "events/events.h"
#include "laws/blast.h"
#include "laws/crust.h"

namespace divot::events {
namespace {

// Ejecta land from the crater's edge outward: the lip is highest at its crest and the blanket ends at 2.15 radii
// [TM 5-855-1]. With the share of the soil that is thrown (Medium::ejecta_share) the exponent sets the lip's height.
constexpr double kBlanketEnd = 2.15, kLipCrest = 1.1, kBlanketExponent = 12;

// Height of the blanket at `ratio` crater radii, 1 at the crest of the lip.
double blanket(double ratio) {
  if (ratio <= 1 || ratio >= kBlanketEnd) return 0;
  if (ratio >= kLipCrest) return std::pow(ratio / kLipCrest, -kBlanketExponent);
  const double t = (ratio - 1) / (kLipCrest - 1);
  return t * t * (3 - 2 * t);
}

struct Target {
  std::uint32_t vertex;
  double radius;  // from ground zero, along the ground, m
  double above;   // height over ground zero, against the blast's direction, m
};

// Every vertex within `reach` of ground zero, ascending, seen along the blast's direction.
std::vector<Target> targets(const state::Blast& blast, double reach, const state::Surface& surface,
                            const geometry::Bvh& bvh, state::RegionScratch& scratch) {
  math::Aabb box;
  const float r = static_cast<float>(reach);
  box.include(blast.ground_zero - Vec3{r, r, r});
  box.include(blast.ground_zero + Vec3{r, r, r});
  std::vector<std::uint32_t> vertices;
  state::vertices_near(surface, bvh, box, scratch, vertices);
  std::vector<Target> found;
  for (const std::uint32_t v : vertices) {
    const Vec3 offset = surface.position[v] - blast.ground_zero;
    const double above = -dot(offset, blast.direction);
    const double radius = std::sqrt(std::max(0.0, static_cast<double>(dot(offset, offset)) - above * above));
    if (radius <= reach) found.push_back({v, radius, above});
  }
  return found;
}

// The ground faces the blast with the mean slope of what it pushes, so that one bump under the bomb does not turn the
// crater.
Vec3 into_ground(const state::Surface& surface, const std::vector<Target>& reached) {
  Vec3 sum;
  for (const Target& t : reached) sum += state::vertex_normal(surface, t.vertex);
  const Vec3 mean = normalized(sum);
  return mean.z > 0 ? -mean : Vec3{0, 0, -1};
}

// What this charge breaks of the crusts around it is gone before the ground below answers.
void break_crusts(const Bomb& bomb, double height, const state::Blast& blast, state::Surface& surface,
                  const geometry::Bvh& bvh, std::span<const laws::Medium> media, state::RegionScratch& scratch) {
  std::vector<double> radius(media.size(), 0.0);
  for (std::size_t m = 0; m < media.size(); ++m) {
    if (media[m].below != laws::kNoLayer)
      radius[m] = laws::broken_radius(media[m], media[media[m].below], bomb.yield, height);
  }
  const double furthest = *std::max_element(radius.begin(), radius.end());
  if (furthest <= 0) return;
  for (const Target& t : targets(blast, furthest, surface, bvh, scratch)) {
    std::uint8_t& material = surface.material[t.vertex];
    while (t.radius < radius[material]) material = media[material].below;
  }
}

// Cube-root scaled model: ground flows where the pressure exceeds its strength, and what is thrown out lands around it.
void push_scaled(const Bomb& bomb, double height, state::Blast& blast, state::Surface& surface, state::Soil& soil,
                 const geometry::Bvh& bvh, std::span<const laws::Medium> media, std::uint32_t zero,
                 state::RegionScratch& scratch) {
  break_crusts(bomb, height, blast, surface, bvh, media, scratch);
  const double strength = media[surface.material[zero]].blast_strength;
  double weakest = strength;
  for (const laws::Medium& m : media) weakest = std::min<double>(weakest, m.blast_strength);
  const double radius = laws::scaled_radius(bomb.yield, strength, height);
  const double reach = std::max(laws::scaled_radius(bomb.yield, weakest, height), kBlanketEnd * radius);
  if (radius <= 0) return;

  const laws::Source source = laws::scaled_source(bomb.yield, strength, height);
  blast.direction = into_ground(surface, targets(blast, radius, surface, bvh, scratch));
  double volume = 0;
  for (const Target& t : targets(blast, reach, surface, bvh, scratch)) {
    const laws::Medium& soil_here = media[surface.material[t.vertex]];
    const double x = source.distance(t.radius, t.above);
    const double excess = laws::scaled_pressure(source, x, (source.height - t.above) / x) - soil_here.blast_strength;
    const double lands = blanket(t.radius / radius);
    if (excess <= 0 && lands <= 0) continue;
    const std::uint32_t column = state::touch_column(surface, soil, t.vertex);
    if (excess > 0) {
      // Flow against the drag d for a pulse T ends excess T / (2 d) deep, whatever its inertia. A push falling to 0
      // over the time P against a relaxation time 2 P ends push P^2 deep.
      const double deep = excess * laws::pulse(bomb.yield) / (2 * soil_here.blast_drag);
      blast.column.push_back(column);
      blast.push.push_back(static_cast<float>(deep / (blast.pulse * blast.pulse)));
    } else {
      blast.landing.push_back(column);
      blast.landing_height.push_back(static_cast<float>(lands));
      volume += lands * soil.area[column];
    }
  }
  for (float& height_share : blast.landing_height) height_share /= static_cast<float>(volume);
  blast.flow_rate = static_cast<float>(1 / (2 * blast.pulse));
}

// The paper's model: eq. 14 on the particles inside the crater width.
void push_paper(const Bomb& bomb, double height, state::Blast& blast, state::Surface& surface, state::Soil& soil,
                const geometry::Bvh& bvh, state::RegionScratch& scratch) {
  const double radius = laws::crater_width(bomb.yield) / 2;
  const laws::Source source = laws::paper_source(bomb.yield, height);
  blast.direction = into_ground(surface, targets(blast, radius, surface, bvh, scratch));
  for (const Target& t : targets(blast, radius, surface, bvh, scratch)) {
    const double x = source.distance(t.radius, t.above);
    blast.column.push_back(state::touch_column(surface, soil, t.vertex));
    blast.push.push_back(static_cast<float>(laws::paper_push(source, x, std::max(0.0, (source.height - t.above) / x))));
  }
}

}  // namespace

state::Blast detonate(const Bomb& bomb, Blast model, double time, double dt, state::Surface& surface, state::Soil& soil,
                      const geometry::Bvh& bvh, std::span<const laws::Medium> media, state::RegionScratch& scratch) {
  // A pulse much shorter than the step is stretched to what the substeps can follow: the scaled crater does not depend
  // on it.
  state::Blast blast{
      .direction = {0, 0, -1}, .yield = bomb.yield, .start = time, .pulse = std::max(laws::pulse(bomb.yield), dt / 8)};
  const Vec3 burst = to_float(bomb.position - surface.origin);
  const state::SurfacePoint ground = state::surface_at(surface, bvh, burst.x, burst.y, scratch);
  blast.ground_zero = ground.found ? ground.position : burst;
  blast.active = ground.found;
  if (!ground.found) return blast;  // beside the terrain, or over a hole
  const double height = std::max(0.0f, burst.z - ground.position.z);
  if (model == Blast::scaled)
    push_scaled(bomb, height, blast, surface, soil, bvh, media, ground.vertex, scratch);
  else
    push_paper(bomb, height, blast, surface, soil, bvh, scratch);
  blast.active = !blast.column.empty();
  return blast;
}

}  // namespace divot::events
