#include "laws/medium.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace divot::laws {

Medium make_medium(const Material& material) {
  const auto f = [](double value) { return static_cast<float>(value); };
  constexpr double kDegree = std::numbers::pi / 180;
  const double cell = material.reference_spacing * material.reference_spacing;
  Medium m{.areal_mass = f(material.particle_mass / cell),
           .bond_energy = f(material.dissociation_energy / cell),
           .attraction = f(material.attraction_exponent),
           .repulsion = f(material.repulsion_exponent),
           .spring_stiffness = f(material.spring_stiffness),
           .yield_strain = f(material.yield_strain),
           .viscous_damping = f(material.viscous_damping),
           .areal_damping = f(material.global_damping / cell),
           .ground = material.ground,
           .bekker_kc = f(material.bekker_kc),
           .bekker_kphi = f(material.bekker_kphi),
           .bekker_n = f(material.bekker_n),
           .elastic_stiffness = f(material.elastic_stiffness),
           .cohesion = f(material.cohesion),
           .tan_friction = f(std::tan(material.friction_angle_deg * kDegree)),
           .shear_modulus = f(material.shear_modulus),
           .restitution = f(material.restitution),
           .density = f(material.density),
           .compaction_limit = f(material.compaction_limit),
           .tan_repose = f(std::tan(material.repose_angle_deg * kDegree)),
           .thickness = f(material.over_thickness),
           .blast_strength = f(material.blast_strength),
           .blast_drag = f(material.blast_drag),
           .ejecta_share = f(material.ejecta_share)};
  m.ground_damping = 2 * f(material.ground_damping_ratio) * std::sqrt(m.elastic_stiffness * m.areal_mass);
  const auto even = [](float e) { return e == 2 * std::floor(e / 2); };
  // Products of so many factors cost less than a power function.
  constexpr float kMostFactors = 32;
  if (even(m.attraction) && even(m.repulsion) && std::max(m.attraction, m.repulsion) <= 2 * kMostFactors) {
    m.half_attraction = static_cast<int>(m.attraction) / 2;
    m.half_repulsion = static_cast<int>(m.repulsion) / 2;
  }
  return m;
}

}  // namespace divot::laws
