#pragma once

#include "laws/medium.h"

namespace divot::laws {

/// The crater of the cube-root scaled model in one soil, on flat ground that was never touched (docs/physics.md).
struct CraterSize {
  double radius = 0;  ///< m, where the ground begins to fail; 0: the charge is too high or too deep to leave a crater
  double depth = 0;   ///< m, at ground zero
  double lip_share = 0;  ///< of the crater's volume that is thrown out or pushed up around it
};

/// Crater of `yield` t of TNT, > 0, whose centre is `height` m above the ground, negative: buried. `gravity` in m/s^2,
/// >= 0: the weight of the soil adds to its strength.
CraterSize scaled_crater(double yield, double height, const Medium& soil, double gravity);

/// Depth at a point of the ground `radius` m from ground zero and `above` m over it, as a share of the depth at ground
/// zero, [0, 1]; 0 from `crater_radius` on where the ground is flat.
double crater_profile(double radius, double above, double crater_radius);

/// Share of the crater's volume that leaves it, [0, 1]: `lip_share`, and whatever the ground around it cannot take up
/// by compaction. `buried`: depth of burst, m.
double leaving_share(const CraterSize& crater, double buried, double compaction_limit);

/// Share of the smaller of two spheres of broken ground, >= 0 m in radius, that lies in the other, [0, 1].
double overlap(double radius_a, double radius_b, double distance);

/// Height of what was thrown (ejecta) and of what was pushed up (upthrust) at `ratio` crater radii from ground zero,
/// each 1 at the crest; 0 inside the crater.
double ejecta_profile(double ratio);
double upthrust_profile(double ratio);
inline constexpr double kEjectaEnd = 2.15, kUpthrustEnd = 4;  ///< crater radii

}  // namespace divot::laws
