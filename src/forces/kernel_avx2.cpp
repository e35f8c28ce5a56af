// Compiled with -mavx2: nothing in here may run before fastest() has looked at the processor.
#define DIVOT_LANES avx2_lanes
#include "forces/kernel_lanes.h"

namespace divot::forces {

void avx2(const Arrays& arrays, std::size_t begin, std::size_t end) { avx2_lanes::choose(arrays, begin, end); }

}  // namespace divot::forces
