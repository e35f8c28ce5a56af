#pragma once

#include <vector>

#include "cli/plot.h"
#include "validation/experiment.h"

namespace divot::validation {

// Names of figures, which are those of their files.
inline constexpr const char* kCraterSize = "crater_size";
inline constexpr const char* kCraterProfile = "crater_profile";
inline constexpr const char* kPlate = "pressure_sinkage";
inline constexpr const char* kDrawbar = "drawbar_pull";
inline constexpr const char* kDrop = "drop";

/// The figures that have curves, drawn of them: curves of one name, style and colour become one, in the order of the
/// experiments.
std::vector<cli::CurveChart> figures(const std::vector<Curve>& curves);

}  // namespace divot::validation
