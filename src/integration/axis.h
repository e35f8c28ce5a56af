#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "integration/integrators.h"

namespace divot::integration {

inline constexpr std::size_t kGrain = 4096;  // particles a thread takes at a time

/// 1 for what is not finite; without a branch, so that loops over particles vectorise.
inline int is_no_number(float x) { return !(std::abs(x) <= std::numeric_limits<float>::max()); }

}  // namespace divot::integration
