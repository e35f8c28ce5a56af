#pragma once

#include "bench/bench.h"

namespace divot::bench {

/// What a picture of a moving world takes when only the ground that changed is sent to the graphics card, and when all
/// of it is: bytes and milliseconds. Draws without a display.
Result<Report> upload(const Request& request);

}  // namespace divot::bench
