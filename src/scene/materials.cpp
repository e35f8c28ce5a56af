#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "divot/material.h"
#include "divot/scene.h"
#include "scene/preset_colors.h"
#include "scene/soils.h"

namespace divot {
namespace {

// The preset `paper` as the scale that blasts are measured by: its craters over the cube root of the charge,
// m/kg^(1/3).
constexpr double kPaperRadius = 0.3566;  // half of eq. 10's 0.7132
constexpr double kPaperDepth = 0.143;    // what its strength and drag give

/// Particles of a layer 0.1 m thick, 1 m apart.
Material material_of(const scene::Soil& soil) {
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
  // The damping ratio and the rate of the paper's medium. The ratio is met on a mesh of 0.02 m and is lower on coarser
  // ones: k_d is the same on every mesh, so that one that damps a coarse mesh as well would be more than substeps can
  // follow on a fine one.
  constexpr double kFine = 0.02;  // m
  m.viscous_damping = kFine * paper.viscous_damping *
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
  m.ejecta_share = soil.ejecta_share;
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
  static const std::vector<Material> presets = [] {
    std::vector<Material> all = {Material{}};
    std::ranges::transform(scene::measured_soils(), std::back_inserter(all), material_of);
    return all;
  }();
  return presets;
}

const Material* find_material(const Scene& scene, std::string_view name) {
  for (const Material& material : scene.materials) {
    if (material.name == name) return &material;
  }
  return find_preset(name);
}

std::string LegendEntry::text() const {
  return color ? fmt::format("#{:06x}", static_cast<std::uint32_t>(pixel)) : fmt::format("{}", pixel);
}

const Material* find_preset(std::string_view name) {
  for (const Material& preset : material_presets()) {
    if (preset.name == name) return &preset;
  }
  return nullptr;
}

}  // namespace divot
