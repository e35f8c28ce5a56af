#pragma once

#include "laws/medium.h"

namespace divot::laws {

// A crust over something softer (Medium::below). Until it breaks the ground answers as the crust alone.

/// Mean pressure under a patch of radius b at which it punches a plug out of the crust, Pa: the strength of the plug's
/// rim, 2 pi b t c, over the patch.
inline double punching_pressure(const Medium& crust, double b) { return 2.0 * crust.thickness * crust.cohesion / b; }

/// How far from ground zero a burst breaks the crust away, m; 0 where it only scars it: where the crater it would make
/// in endless crust is no deeper than the crust. A thick crust breaks as far as that crater reaches, one that is thin
/// against it as far as a crater in the softer ground would; between, in proportion. A charge that is buried below the
/// crust breaks it as far as the softer ground fails. `height` of burst in m, negative: buried.
double broken_radius(const Medium& crust, const Medium& below, double yield, double height, double gravity);

}  // namespace divot::laws
