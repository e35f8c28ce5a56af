#pragma once

// The one place that includes toml++. Debian's build of it throws, so that everyone here calls it through parse_toml.
#include <toml++/toml.h>

#include <string>
#include <string_view>

#include "divot/errors.h"

namespace divot::scene {

/// The document, whose nodes know `source` and their lines; or toml++'s description of what is wrong in it.
Result<toml::table> parse_toml(std::string_view text, const std::string& source);

/// A value as an error shows it: `"heavy" is text`, `37.5 is a number`, `is a table`.
std::string described(const toml::node& node);

/// `text` as a TOML string.
std::string quoted(std::string_view text);

}  // namespace divot::scene
