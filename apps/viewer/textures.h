#pragma once

#include <span>
#include <string>

#include "divot/errors.h"
#include "divot/material.h"

namespace divot::viewer {

/// Fails with every texture that is no picture, by its key `materials.NAME.texture`. `folder`: where relative paths
/// start. [O(pixels of all textures)]
Result<void> check_textures(std::span<const Material> materials, const std::string& folder);

}  // namespace divot::viewer
