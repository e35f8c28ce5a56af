// Compiled with -mavx512vl: nothing in here may run before fastest() has looked at the processor. Vectors are still
// eight wide: what counts are the registers, twice as many, so that bonds need no memory between loads.
#define DIVOT_LANES avx512_lanes
#include "forces/kernel_lanes.h"

namespace divot::forces {

void avx512(const Arrays& arrays, std::size_t begin, std::size_t end) { avx512_lanes::choose(arrays, begin, end); }

}  // namespace divot::forces
