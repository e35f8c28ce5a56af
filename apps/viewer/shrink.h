#pragma once

#include "viewer/image.h"

namespace divot::viewer {

/// `image` at `width` pixels, its height in proportion (at least 1): each pixel is the mean of what it covers. The
/// image itself where it is not wider. `width` >= 1. [O(pixels)]
Image shrink(const Image& image, int width);

}  // namespace divot::viewer
