#define DIVOT_LANES baseline_lanes
#include "settle/ring_lanes.h"

namespace divot::settle {

const RingKernel kRingsBaseline{baseline_lanes::sweep, baseline_lanes::look};

}  // namespace divot::settle
