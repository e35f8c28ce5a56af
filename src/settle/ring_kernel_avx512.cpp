// Compiled with -mavx512vl: nothing in here may run before fastest_rings() has looked at the processor.
#define DIVOT_LANES avx512_lanes
#include "settle/ring_lanes.h"

namespace divot::settle {

const RingKernel kRingsAvx512{avx512_lanes::sweep, avx512_lanes::look};

}  // namespace divot::settle
