#pragma once

#include "divot/errors.h"

namespace divot::viewer {

/// What a display can do.
struct Display {
  bool accelerated = true;  ///< false: OpenGL is done by the processor
};

/// Looks at the display that windows would open on. Fails when there is none, or none that knows OpenGL, and says what
/// to do.
Result<Display> open_display();

}  // namespace divot::viewer
