#pragma once

#include <string>

#include "validation/runner.h"

namespace divot::validation {

/// A case's row in docs/validation.md up to what was simulated: what the program knows without running anything.
std::string row_start(const Case& one);

/// docs/validation.md: tables of every family, figures, and what is left out and why. `charts` are drawn into the
/// folder `validation` beside it.
Result<std::string> page(const std::vector<Chosen>& chosen, const Findings& findings,
                         const std::vector<cli::CurveChart>& charts, const Places& places);

}  // namespace divot::validation
