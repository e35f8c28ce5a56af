#pragma once

#include <span>
#include <string>
#include <string_view>

#include "divot/errors.h"

namespace divot {

/// The soil of a part of the terrain. Plain numbers in SI; docs/physics.md has the laws and the source of each preset's
/// values.
struct Material {
  std::string name = "paper";  ///< what scenes call it

  // The particle system (eq. 1-6). Mass, dissociation energy and global damping belong to particles that stand
  // `reference_spacing` apart; on any other mesh they scale with the square of the spacing, so that results do not
  // depend on it.
  double reference_spacing = 10.9;     ///< m, > 0
  double particle_mass = 1.0;          ///< kg, > 0
  double dissociation_energy = 300.0;  ///< e0 of eq. 6, J, >= 0
  double attraction_exponent = 2.0;    ///< m of eq. 6, > 0
  double repulsion_exponent = 4.0;     ///< n of eq. 6, > attraction_exponent
  double spring_stiffness = 20.2;      ///< k_s of eq. 1, N/m, >= 0; used with cohesion = "mass_spring"
  double yield_strain = 0.02;          ///< bonds keep their length up to this strain and flow beyond it, > 0
  double viscous_damping = 0.2;        ///< k_d of eq. 2, N s/m, >= 0
  double global_damping = 0.5;         ///< gamma of eq. 3, kg/s, >= 0

  // The ground under a particle: p = (kc/b + kphi) z^n [Bekker 1969], tau = (c + p tan phi)(1 - exp(-j/K)) [Janosi &
  // Hanamoto 1961].
  bool ground = true;                  ///< false: the bare particle sheet of the paper, with nothing below it
  double bekker_kc = 0.0;              ///< N/m^(n+1)
  double bekker_kphi = 1.2;            ///< N/m^(n+2); kc/b + kphi must stay > 0
  double bekker_n = 1.0;               ///< 1, in (0, 3]
  double elastic_stiffness = 12.0;     ///< unloading and reloading, Pa/m, > 0
  double ground_damping_ratio = 0.15;  ///< of ground that moves with a particle or is compressed, 1 is critical, >= 0
  double cohesion = 1.0;               ///< c, Pa, >= 0
  double friction_angle_deg = 30.0;    ///< phi, degrees, [0, 60]
  double shear_modulus = 0.5;          ///< K of Janosi-Hanamoto, m, > 0
  double restitution = 0.3;            ///< multiplied by the body's, [0, 1]

  // What becomes of soil that is pressed or thrown.
  double density = 0.084;          ///< kg/m^3 of undisturbed soil, > 0; the paper's 1 kg at 10.9 m, 0.1 m thick
  double compaction_limit = 0.3;   ///< largest share of its volume that the soil can lose by compaction, [0, 1)
  double repose_angle_deg = 45.0;  ///< slopes of loose soil at rest are no steeper, degrees, (0, 89]

  // A crust over something softer: until it breaks, the ground answers as this material does, then as what lies below.
  std::string over = {};        ///< a name in Scene::materials or of a preset; empty: this material all the way down
  double over_thickness = 0.1;  ///< m of this material above it, > 0; means nothing without `over`

  // What a blast meets (scaled blast, docs/physics.md): the soil fails where the pressure exceeds its strength and
  // flows against its drag.
  double blast_strength = 985.0;  ///< Pa, > 0: sets the crater's width
  double blast_drag = 0.94;       ///< Pa s/m, > 0: sets the crater's depth
  double ejecta_share =
      0.185;  ///< share of the crater's volume that lands on lip and blanket, [0, 1); the rest is compacted

  // How pictures show it. The library carries this and computes nothing from it.
  std::string color = {};    ///< `#rrggbb` as a screen shows it; empty: up to what draws it
  std::string texture = {};  ///< a PNG or JPEG picture laid out over the ground again and again, in place of `color`;
                             ///< relative paths start at Scene::folder; empty: none
  double texture_size = 10;  ///< m of ground that the picture covers along x and y, > 0
};

/// The presets by name: `paper`, the medium of the paper, then `dry_sand`, `lete_sand`, `sandy_loam`, `clay_dry`,
/// `clay_wet`, `mud`, `snow`, `wheat_field`, `gravel`, `lunar_regolith`, `asphalt`, `concrete` and `rock`.
std::span<const Material> material_presets();

/// The preset of that name, or nullptr.
const Material* find_preset(std::string_view name);

/// What is out of range in `material`, empty when nothing is. `Error::key` is the field's name.
Errors check(const Material& material);

}  // namespace divot
