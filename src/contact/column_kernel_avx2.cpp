// Compiled with -mavx2: nothing in here may run before fastest_columns() has looked at the processor.
#define DIVOT_LANES avx2_lanes
#include "contact/column_lanes.h"

namespace divot::contact {

const ColumnKernel kColumnsAvx2{avx2_lanes::freeze, avx2_lanes::add<true>, avx2_lanes::add<false>, avx2_lanes::load,
                                avx2_lanes::end};

}  // namespace divot::contact
