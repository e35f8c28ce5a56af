// Compiled with -mavx512vl: nothing in here may run before fastest_columns() has looked at the processor.
#define DIVOT_LANES avx512_lanes
#include "contact/column_lanes.h"

namespace divot::contact {

const ColumnKernel kColumnsAvx512{avx512_lanes::freeze, avx512_lanes::add<true>, avx512_lanes::add<false>,
                                  avx512_lanes::load, avx512_lanes::end};

}  // namespace divot::contact
