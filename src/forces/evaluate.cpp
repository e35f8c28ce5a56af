#include "forces/evaluate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "forces/kernel.h"

namespace divot::forces {
namespace {

constexpr std::size_t kGrain = 512, kBlockGrain = 128;

Terms terms_of(const laws::Medium& medium, const laws::Resolution& resolution) {
  return {.medium = medium,
          .bond_stiffness = medium.bond_stiffness(),
          .soften_bonds = resolution.stiffness_limit() / laws::lattice_stiffness(medium),
          .soften_damping = resolution.damping_limit() / laws::kLatticeDamping,
          .held_stiffness = laws::held_stiffness(medium, resolution),
          .held_damping = laws::held_damping(medium, resolution),
          .global_damping = laws::global_damping(medium, resolution),
          .shortest = 1 / (1 + medium.yield_strain),
          // Nothing can be squeezed by more than its length.
          .longest = medium.yield_strain < 1 ? 1 / std::max(1 - medium.yield_strain, 0.1f) : 1e30f};
}

// Where the kernel finds everything.
// As wide as registers are, and faster than a search that stops.
bool is_any_positive(const std::vector<float>& numbers) {
  int found = 0;
  for (const float x : numbers) found |= x > 0;
  return found != 0;
}

Arrays arrays_of(state::Particles& p, state::Bonds& bonds, const state::MotionView& m, const Field& field,
                 const std::vector<Terms>& terms, Renew renew) {
  static_assert(sizeof(Vec3) == 3 * sizeof(float) && sizeof(Hold) == 1);
  const auto reach = [&] {
    const float squared = field.cutoff * field.cutoff;
    return Reach{squared, 1 / (0.19f * squared), field.cohesion == Cohesion::mass_spring};
  };
  return {.count = p.size(),
          .x = m.x.data(),
          .y = m.y.data(),
          .z = m.z.data(),
          .vx = m.vx.data(),
          .vy = m.vy.data(),
          .vz = m.vz.data(),
          .mass = p.mass.data(),
          .flow_rate = p.flow_rate.data(),
          .hold = reinterpret_cast<const std::uint8_t*>(p.hold.data()),
          .material = p.material.data(),
          .column = p.column.data(),
          .fx = p.fx.data(),
          .fy = p.fy.data(),
          .fz = p.fz.data(),
          .held_pull = p.held_pull.data(),
          .rest = &field.soil.rest.data()->x,
          .plastic = field.soil.plastic.data(),
          .area = field.soil.cell.data(),
          .first_slot = bonds.first.data(),
          .neighbour = bonds.neighbour.data(),
          .reads = bonds.reads.data(),
          .medium = bonds.medium.data(),
          .rest_length = bonds.rest_length.data(),
          .terms = terms.data(),
          .reach = reach(),
          .renew = renew == Renew::yes,
          .softened = field.resolution.rate < kFollowsAll,
          .flowing = renew == Renew::yes && is_any_positive(p.flow_rate)};
}

void add_blast(state::Particles& p, const state::Blast& blast, const Field& field, float shape, const Jobs& jobs) {
  const auto push = [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t i = field.soil.particle[blast.column[k]];
      if (i == kNone || p.hold[i] != Hold::free) continue;
      const Vec3 force = (p.mass[i] * blast.push[k] * shape) * blast.direction;
      p.fx[i] += force.x, p.fy[i] += force.y, p.fz[i] += force.z;
    }
  };
  jobs.for_ranges(blast.column.size(), kGrain, std::ref(push));
}

void yield_ground(std::size_t i, const state::Particles& p, state::Soil& soil, const laws::Medium& medium,
                  const laws::Resolution& resolution) {
  const std::uint32_t c = p.column[i];
  Vec3& rest = soil.rest[c];
  if (p.flow_rate[i] > 0) {
    rest = p.position(i);
    soil.plastic[c] = 0;
    return;
  }
  if (!medium.ground) return;
  // Pressed onto Bekker's curve: sinkage stays, but for the elastic part. Pulled beyond cohesion: the column follows
  // up.
  const float fresh = soil.fresh_height(c), sunk = rest.z - p.z[i],
              stiffness = laws::held_stiffness(medium, resolution);
  if (sunk > 0) {
    const float z = fresh - p.z[i];
    const auto pressure =
        laws::ground_pressure(medium, z, soil.plastic[c], std::numeric_limits<float>::infinity(), stiffness);
    if (pressure.yields) {
      soil.plastic[c] = z - pressure.value / stiffness;
      rest.z = fresh - soil.plastic[c];
    }
  } else if (const float holds = medium.cohesion + medium.weight; - sunk * stiffness > holds) {
    rest.z = p.z[i] - holds / stiffness;
    soil.plastic[c] = std::max(0.0f, fresh - rest.z);
  }
  // Sheared so far that the soil slides.
  const float dx = p.x[i] - rest.x, dy = p.y[i] - rest.y, j = std::sqrt(dx * dx + dy * dy);
  const float slide = laws::kSlideShear * medium.shear_modulus;
  if (j > slide) rest.x += dx * (1 - slide / j), rest.y += dy * (1 - slide / j);
}

}  // namespace

float pulse_shape(const state::Blast& blast, double time) {
  return static_cast<float>(std::clamp(1 - (time - blast.start) / blast.pulse, 0.0, 1.0));
}

void evaluate(state::Particles& p, state::Bonds& bonds, const state::MotionView& motion, double time,
              const Field& field, Renew renew, Scratch& scratch, const Jobs& jobs, Kernel* kernel) {
  if (p.size() == 0) return;
  scratch.terms.clear();
  for (const laws::Medium& medium : field.media) scratch.terms.push_back(terms_of(medium, field.resolution));
  const Arrays arrays = arrays_of(p, bonds, motion, field, scratch.terms, renew);
  const auto work = [&](std::size_t begin, std::size_t end) { kernel(arrays, begin, end); };
  // By reference: a copy in std::function would be an allocation.
  jobs.for_ranges(bonds.block_count(), kBlockGrain, std::ref(work));
  for (const state::Blast& blast : field.blasts)
    if (const float shape = pulse_shape(blast, time); blast.active && shape > 0)
      add_blast(p, blast, field, shape, jobs);
}

void yield(const state::Particles& p, state::Soil& soil, std::span<const laws::Medium> media,
           const laws::Resolution& resolution, const Jobs& jobs) {
  const auto work = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (p.hold[i] == Hold::free) yield_ground(i, p, soil, media[p.material[i]], resolution);
  };
  jobs.for_ranges(p.size(), kGrain, std::ref(work));
}

}  // namespace divot::forces
