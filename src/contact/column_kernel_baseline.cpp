#define DIVOT_LANES baseline_lanes
#include "contact/column_lanes.h"

namespace divot::contact {

const ColumnKernel kColumnsBaseline{baseline_lanes::freeze, baseline_lanes::add<true>, baseline_lanes::add<false>,
                                    baseline_lanes::load, baseline_lanes::end};

}  // namespace divot::contact
