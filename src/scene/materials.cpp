#include <array>
#include <cmath>

#include "divot/material.h"
#include "scene/preset_colors.h"

namespace divot {
namespace {

/// A soil as it is measured. The particle system's and the blast's values follow from it.
struct Soil {
  const char* name;
  double density;            ///< kg/m^3
  double kc, kphi, n;        ///< N/m^(n+1), N/m^(n+2), 1
  double elastic_stiffness;  ///< Pa/m
  double cohesion;           ///< Pa
  double friction_angle_deg;
  double shear_modulus;  ///< m
  double restitution;
  double compaction_limit;
  double repose_angle_deg;
  double yield_strain;
  double crater_radius, crater_depth;  ///< over the cube root of the charge, m/kg^(1/3)
};

constexpr Soil kDrySand = {
    .name = "dry_sand",
    .density = 1600,               // engineering value: dry quartz sand
    .kc = 0.99e3,                  // [Wong 2008] "Dry sand (LLL)"
    .kphi = 1528.4e3,              // the same
    .n = 1.1,                      // the same
    .elastic_stiffness = 93.97e6,  // Keweenaw Research Center, fine grain dry: k0 of unloading
    .cohesion = 1.04e3,            // [Wong 2008] "Dry sand (LLL)"
    .friction_angle_deg = 28,      // the same
    .shear_modulus = 0.02,         // typical of sand, not measured with the rest
    .restitution = 0.1,            // engineering value: sand swallows a drop
    .compaction_limit = 0.1,       // engineering value: from 1600 to some 1770 kg/m^3, as dense as sand is tamped
    .repose_angle_deg = 34,        // dry sand: 30 to 35 degrees wherever it is measured
    .yield_strain = 0.02,          // engineering value: grains slide almost at once
    .crater_radius = 0.297,        // [TM 5-855-1] dry sand
    .crater_depth = 0.149,         // the same
};

constexpr Soil kMud = {
    .name = "mud",
    .density = 1800,            // engineering value: sandy loam at 32 % moisture
    .kc = 0.77e3,               // [Wong 2008] "Sandy loam (Hanamoto)", 32 %
    .kphi = 51.91e3,            // the same
    .n = 0.5,                   // the same
    .elastic_stiffness = 10e6,  // engineering value: about 200 times kphi
    .cohesion = 5.17e3,         // [Wong 2008] "Sandy loam (Hanamoto)", 32 %
    .friction_angle_deg = 11,   // the same
    .shear_modulus = 0.02,      // typical, not measured with the rest
    .restitution = 0.05,        // engineering value: mud swallows nearly all of a drop
    .compaction_limit = 0.03,   // engineering value: pores full of water, which does not leave at once
    .repose_angle_deg = 12,     // engineering value: little above its angle of friction
    .yield_strain = 0.05,       // engineering value: wet soil stretches further than dry before it flows
    .crater_radius = 0.456,     // [TM 5-855-1] wet clay
    .crater_depth = 0.228,      // the same
};

constexpr Soil kAsphalt = {
    .name = "asphalt",
    .density = 2400,            // engineering value: asphalt concrete
    .kc = 0,                    // engineering value: stiffness does not depend on the plate
    .kphi = 5e9,                // engineering value: a truck's tyre at 0.7 MPa sinks 0.14 mm
    .n = 1,                     // engineering value: linear
    .elastic_stiffness = 2e10,  // engineering value: modulus of 2 GPa over a layer of 0.1 m
    .cohesion = 1e6,            // engineering value: a bound mix, hundreds of times mud's
    .friction_angle_deg = 40,   // engineering value: interlocked crushed stone
    .shear_modulus = 0.001,     // engineering value: shears at 1 % of the layer
    .restitution = 0.7,         // engineering value: a hard ball on a road
    .compaction_limit = 0.05,   // engineering value: what air a rolled mix still holds
    .repose_angle_deg = 45,     // engineering value: broken pieces that interlock
    .yield_strain = 0.005,      // engineering value: cracks at a few tenths of a percent
    .crater_radius = 0.151,     // [TM 5-855-1] concrete slab
    .crater_depth = 0.079,      // the same
};

// The preset `paper` as the scale that blasts are measured by: its craters over the cube root of the charge,
// m/kg^(1/3).
constexpr double kPaperRadius = 0.3566;  // half of eq. 10's 0.7132
constexpr double kPaperDepth = 0.143;    // what its strength and drag give

/// Particles of a layer 0.1 m thick, 1 m apart.
Material material_of(const Soil& soil) {
  constexpr double kLayer = 0.1;  // m
  const Material paper;
  Material m;
  m.name = soil.name;
  m.reference_spacing = 1;
  m.particle_mass = soil.density * kLayer;
  // A bond's strongest pull, 223.08/300 e0 / r0 for exponents 2 and 4, is the soil's cohesion over the bond's section.
  m.dissociation_energy = soil.cohesion * kLayer / (223.08 / 300);
  // As stiff as that bond at rest: e0 m n / r0^2.
  m.spring_stiffness = 8 * m.dissociation_energy;
  m.yield_strain = soil.yield_strain;
  // The damping ratio and the rate of the paper's medium.
  m.viscous_damping = paper.viscous_damping *
                      std::sqrt(m.spring_stiffness / paper.spring_stiffness * m.particle_mass / paper.particle_mass);
  m.global_damping = paper.global_damping * m.particle_mass / paper.particle_mass;
  // Waves that carry energy away from a loaded patch: a tenth to a half of critical in footings on soil.
  m.ground_damping_ratio = 0.3;
  m.bekker_kc = soil.kc;
  m.bekker_kphi = soil.kphi;
  m.bekker_n = soil.n;
  m.elastic_stiffness = soil.elastic_stiffness;
  m.cohesion = soil.cohesion;
  m.friction_angle_deg = soil.friction_angle_deg;
  m.shear_modulus = soil.shear_modulus;
  m.restitution = soil.restitution;
  m.density = soil.density;
  m.compaction_limit = soil.compaction_limit;
  m.repose_angle_deg = soil.repose_angle_deg;
  // A blast's pressure falls with the cube of distance and depth goes with strength over drag.
  const double ratio = kPaperRadius / soil.crater_radius;
  const double strength = ratio * ratio * ratio;
  m.blast_strength = paper.blast_strength * strength;
  m.blast_drag = paper.blast_drag * strength * kPaperDepth / soil.crater_depth;
  m.color = scene::preset_color(soil.name);
  return m;
}

}  // namespace

std::span<const Material> material_presets() {
  static const std::array<Material, 4> presets = {Material{}, material_of(kDrySand), material_of(kMud),
                                                  material_of(kAsphalt)};
  return presets;
}

const Material* find_preset(std::string_view name) {
  for (const Material& preset : material_presets()) {
    if (preset.name == name) return &preset;
  }
  return nullptr;
}

}  // namespace divot
