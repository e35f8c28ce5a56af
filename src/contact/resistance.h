#pragma once

#include "math/six.h"

namespace divot::contact {

/// What resists a change of a body's velocity within a step, and what its velocity already contains.
struct Resistance {
  math::Matrix6 whole{};  ///< lower half; inertia and the slope of the soil's answer against velocity: kg, kg m, kg m^2
  math::Row steady{};     ///< N s, N m s: impulse of joints and other bodies, taken to be that of the last step
};

}  // namespace divot::contact
