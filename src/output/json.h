#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "divot/errors.h"

namespace divot::output {

/// Writes JSON, indented. Fails with the system's reason, and on a number that JSON has no word for (not finite),
/// naming its place; nothing is written then.
Result<void> write_json(const std::string& path, const nlohmann::ordered_json& json);

}  // namespace divot::output
