#pragma once

#include <string>

#include "divot/output.h"
#include "divot/world.h"

namespace divot::cli {

/// What came of a run, in a few aligned lines for people. `folder`: where its results are.
std::string run_summary(const World& world, const RunTotals& totals, const std::string& folder);

}  // namespace divot::cli
