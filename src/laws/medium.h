#pragma once

#include <algorithm>
#include <cstdint>

#include "divot/material.h"

namespace divot::laws {

/// Medium::below of one that is the same all the way down.
inline constexpr std::uint8_t kNoLayer = 255;

/// A material as the stages use it: per unit of area, in floats. Made once from the checked Material.
struct Medium {
  float areal_mass = 0;        ///< kg/m^2 of particles
  float weight = 0;            ///< Pa, of particles: what lifts them off the ground has to overcome; world/ sets it
  float bond_energy = 0;       ///< J/m^2: e0 of a bond is this times its rest length squared
  float attraction = 0;        ///< m of eq. 6
  float repulsion = 0;         ///< n of eq. 6
  int half_attraction = 0;     ///< m / 2 where both exponents are even and small (no power function), else 0
  int half_repulsion = 0;      ///< n / 2 likewise
  float spring_stiffness = 0;  ///< k_s of eq. 1, N/m
  float yield_strain = 0;
  float viscous_damping = 0;  ///< k_d of eq. 2, N s/m
  float areal_damping = 0;    ///< gamma of eq. 3 per area, kg/(s m^2)
  bool ground = true;
  float bekker_kc = 0, bekker_kphi = 0, bekker_n = 1;
  float elastic_stiffness = 0;  ///< Pa/m
  float ground_damping = 0;     ///< Pa s/m
  float cohesion = 0;           ///< Pa
  float tan_friction = 0;
  float shear_modulus = 1;  ///< K, m
  float restitution = 0;
  float density = 1;  ///< kg/m^3
  float compaction_limit = 0;
  float tan_repose = 1;           ///< steepest slope of loose soil at rest
  std::uint8_t below = kNoLayer;  ///< index of the medium that this one is a crust over; world/ sets it
  float thickness = 0;            ///< m of crust
  float blast_strength = 0;       ///< Pa
  float blast_drag = 0;           ///< Pa s/m
  float ejecta_share = 0;

  /// Stiffest a bond can be, N/m: the curvature of eq. 6 at rest, e0 m n / r0^2, or eq. 1's.
  float bond_stiffness() const { return std::max(bond_energy * attraction * repulsion, spring_stiffness); }
};

/// What a particle among its eight neighbours feels at most: the highest eigenvalue of a square lattice's stiffness is
/// 8 bonds', of its damping 16 bonds'.
inline float lattice_stiffness(const Medium& medium) { return 8 * medium.bond_stiffness(); }
inline constexpr float kLatticeDamping = 16;

/// The medium of a material.
Medium make_medium(const Material& material);

}  // namespace divot::laws
