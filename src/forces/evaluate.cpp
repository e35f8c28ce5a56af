#include "forces/evaluate.h"

#include <algorithm>
#include <cmath>

#include "laws/damping.h"
#include "laws/lennard_jones.h"
#include "laws/mass_spring.h"

namespace divot::forces {
namespace {

constexpr std::size_t kGrain = 512;

// Of two materials the weaker holds the bond; the order of the pair does not matter.
const laws::Medium& weaker(const laws::Medium& a, const laws::Medium& b) {
  return b.bond_stiffness() < a.bond_stiffness() ? b : a;
}

// 1 up to 90 % of the cutoff, then smoothly to 0 at the cutoff: pairs leave and come without a jump.
float fade(float r, float cutoff) {
  const float t = std::clamp((cutoff - r) / (0.1f * cutoff), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

// Cohesion (eq. 6 or 1) and viscous damping (eq. 2) of all bonds of particle i.
Vec3 pair_force(std::size_t i, const state::Particles& p, const state::MotionView& m, const Field& field) {
  const Vec3 x_i{m.x[i], m.y[i], m.z[i]}, v_i{m.vx[i], m.vy[i], m.vz[i]};
  const laws::Medium& own = field.media[p.material[i]];
  Vec3 sum;
  for (std::uint32_t e = field.bonds.start[i]; e < field.bonds.start[i + 1]; ++e) {
    const float r0 = field.bonds.rest_length[e];
    if (r0 == 0) continue;
    const std::uint32_t j = field.bonds.neighbour[e];
    const Vec3 apart = x_i - Vec3{m.x[j], m.y[j], m.z[j]};
    const float r_squared = dot(apart, apart), r = std::sqrt(r_squared);
    if (r >= field.cutoff || r == 0) continue;
    const laws::Medium& medium = weaker(own, field.media[p.material[j]]);
    const float cohesion = field.cohesion == Cohesion::lennard_jones ? laws::lennard_jones(medium, r_squared, r0)
                                                                     : laws::mass_spring(medium, r, r0);
    const float near = fade(r, field.cutoff), lighter = std::min(p.mass[i], p.mass[j]);
    const float soften = std::min(1.0f, lighter * field.resolution.stiffness_limit() / laws::lattice_stiffness(medium));
    const float damping =
        std::min(medium.viscous_damping, lighter * field.resolution.damping_limit() / laws::kLatticeDamping);
    sum += (near * soften * cohesion) * apart;
    sum += laws::viscous_damping(near * damping, v_i, {m.vx[j], m.vy[j], m.vz[j]});
  }
  return sum;
}

// Ground or flow under a free particle, and eq. 3.
Vec3 own_force(std::size_t i, const state::Particles& p, const state::MotionView& m, const Field& field) {
  const laws::Medium& medium = field.media[p.material[i]];
  const std::uint32_t column = p.column[i];
  const float area = field.soil.area[column];
  const Vec3 v{m.vx[i], m.vy[i], m.vz[i]};
  // Soil that a blast has made flow has no skeleton left: it resists by drag alone, in the place of eq. 3, until it
  // rests.
  if (p.flow_rate[i] > 0) return laws::global_damping(p.mass[i] * p.flow_rate[i], v);
  const Vec3 force = laws::global_damping(medium.areal_damping * area, v);
  if (!medium.ground) return force;
  const Vec3 from_rest = Vec3{m.x[i], m.y[i], m.z[i]} - field.soil.rest[column];
  return force + area * laws::ground_traction(medium, from_rest, v, field.soil.plastic[column], field.resolution);
}

void add_blast(state::Particles& p, const state::Blast& blast, const Field& field, float shape, const Jobs& jobs) {
  jobs.for_ranges(blast.column.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t i = field.soil.particle[blast.column[k]];
      if (i == kNone || p.hold[i] != Hold::free) continue;
      const Vec3 force = (p.mass[i] * blast.push[k] * shape) * blast.direction;
      p.fx[i] += force.x, p.fy[i] += force.y, p.fz[i] += force.z;
    }
  });
}

// A bond keeps its length up to the yield strain and follows beyond it.
void yield_bonds(std::size_t i, const state::Particles& p, state::Bonds& bonds, std::span<const laws::Medium> media) {
  for (std::uint32_t e = bonds.start[i]; e < bonds.start[i + 1]; ++e) {
    float& r0 = bonds.rest_length[e];
    if (r0 == 0) continue;
    const std::uint32_t j = bonds.neighbour[e];
    const Vec3 apart = p.position(i) - p.position(j);
    const float r = length(apart);
    const float strain = weaker(media[p.material[i]], media[p.material[j]]).yield_strain;
    r0 = std::clamp(r0, r / (1 + strain), r / std::max(1 - strain, 0.1f));
  }
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
  } else if (-sunk * stiffness > medium.cohesion) {
    rest.z = p.z[i] - medium.cohesion / stiffness;
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

void evaluate(state::Particles& p, const state::MotionView& motion, double time, const Field& field, const Jobs& jobs) {
  // Bound by arithmetic: about 8 bonds a particle, all within cache once rows are in order of vertices.
  jobs.for_ranges(p.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Vec3 force;
      if (p.hold[i] != Hold::anchor) {
        force = pair_force(i, p, motion, field);
        p.held_pull[i] = force.z;
        force = p.hold[i] == Hold::free ? force + own_force(i, p, motion, field) : Vec3{};
      }
      p.fx[i] = force.x, p.fy[i] = force.y, p.fz[i] = force.z;
    }
  });
  for (const state::Blast& blast : field.blasts)
    if (const float shape = pulse_shape(blast, time); blast.active && shape > 0)
      add_blast(p, blast, field, shape, jobs);
}

void yield(const state::Particles& p, state::Bonds& bonds, state::Soil& soil, std::span<const laws::Medium> media,
           const laws::Resolution& resolution, const Jobs& jobs) {
  jobs.for_ranges(p.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      yield_bonds(i, p, bonds, media);
      if (p.hold[i] == Hold::free) yield_ground(i, p, soil, media[p.material[i]], resolution);
    }
  });
}

}  // namespace divot::forces
