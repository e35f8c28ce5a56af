#pragma once

#include <string>

#include "divot/scene.h"

namespace divot::bench {

/// The paper's scene; its bomb goes off at once and its ball is on its way, so that there is something to see.
Result<Scene> paper_scene(const std::string& scenes);

/// A wheel's ball that ploughs through mud: 500 000 triangles, of which a few hundred move.
Result<Scene> rolling_scene(const std::string& scenes);

}  // namespace divot::bench
