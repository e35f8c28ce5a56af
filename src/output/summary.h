#pragma once

#include <nlohmann/json.hpp>

#include "divot/world.h"

namespace divot::output {

/// What `summary.json` holds: the run in numbers. `wall_s` is the time it took, s.
nlohmann::ordered_json summary(const World& world, double wall_s);

}  // namespace divot::output
