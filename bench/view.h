#pragma once

#include "bench/bench.h"

namespace divot::bench {

/// What a picture of the running window takes at 1280 x 720, on the paper's scene and on 500 000 triangles: steps,
/// numbers, flash and dust included, drawn without a display.
Result<Report> view(const Request& request);

}  // namespace divot::bench
