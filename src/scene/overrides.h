#pragma once

#include <optional>
#include <string>

#include "divot/scene.h"
#include "scene/toml.h"

namespace divot::scene {

/// How the source of an override's values begins: no file is called so.
inline constexpr const char* kOverrideSource = "--set ";

/// What errors call the source of an override's values: `--set bodies.0.mass`.
std::string source_of(const Override& override);

/// Puts an override's value into `document`, where its nodes say that they come from source_of(override). Returns what
/// is wrong with its path or value and then leaves the document as it was.
std::optional<Error> apply_override(toml::table& document, const Override& override);

}  // namespace divot::scene
