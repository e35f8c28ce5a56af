// Compiled with -mavx2: nothing in here may run before fastest_rings() has looked at the processor.
#define DIVOT_LANES avx2_lanes
#include "settle/ring_lanes.h"

namespace divot::settle {

const RingKernel kRingsAvx2{avx2_lanes::sweep, avx2_lanes::look};

}  // namespace divot::settle
