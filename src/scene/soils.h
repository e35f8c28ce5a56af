#pragma once

#include <span>

namespace divot::scene {

/// A soil as it is measured. The particle system's and the blast's values follow from it (materials.cpp).
struct Soil {
  const char* name;
  double density;               ///< kg/m^3
  double kc, kphi, n;           ///< N/m^(n+1), N/m^(n+2), 1: Bekker's, with b the radius of the patch
  double elastic_stiffness;     ///< Pa/m
  double cohesion;              ///< Pa
  double friction_angle_deg;    ///< degrees
  double shear_modulus;         ///< m
  double restitution;           ///< 1
  double compaction_limit;      ///< 1
  double repose_angle_deg;      ///< degrees
  double yield_strain;          ///< 1
  double crater_radius;         ///< of a charge on the surface, over its cube root, m/kg^(1/3)
  double crater_depth;          ///< likewise
  double ejecta_share = 0.185;  ///< lips of dry sand hold 15 to 20 % of a crater's volume [EPG]; nothing else measured
};

/// Every soil that is a preset.
std::span<const Soil> measured_soils();

}  // namespace divot::scene
