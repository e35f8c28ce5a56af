#pragma once

#include <string>

#include "divot/world.h"

namespace divot::viewer {

/// The first of `prefix_001suffix`, `prefix_002suffix` ... that does not exist in `folder`. [O(files of that name)]
std::string free_path(const std::string& folder, const std::string& prefix, const std::string& suffix);

/// Writes what a run leaves (ground, bodies, summary) into a new folder within `folder`, and returns its path.
/// `seconds`: that the run has taken. [O(vertices)]
Result<std::string> save_state(const World& world, const std::string& folder, double seconds);

}  // namespace divot::viewer
