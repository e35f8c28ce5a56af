#pragma once

#include <nlohmann/json.hpp>

#include "divot/output.h"
#include "divot/world.h"

namespace divot::output {

/// What `summary.json` holds: the run in numbers.
nlohmann::ordered_json summary(const World& world, const RunTotals& totals);

}  // namespace divot::output
