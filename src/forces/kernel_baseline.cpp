#define DIVOT_LANES baseline_lanes
#include "forces/kernel_lanes.h"

namespace divot::forces {

void baseline(const Arrays& arrays, std::size_t begin, std::size_t end) { baseline_lanes::choose(arrays, begin, end); }

}  // namespace divot::forces
