#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "divot/material.h"
#include "viewer/look.h"

namespace divot::viewer {

inline constexpr std::size_t kScaleStops = 5;

/// Colours for a number on the ground, evenly spaced from `low` to `high` and blended between.
struct ColorScale {
  using Rgb = std::array<float, 3>;  // as shown (sRGB), 0 to 1
  std::array<Rgb, kScaleStops> stops = {};
  float low = 0, high = 1;               ///< of the number, in its unit
  std::string title = {};                ///< what the number is, with its unit; empty for natural colours
  std::vector<std::string> labels = {};  ///< of each stop from the first on, where the colours are no continuum
};

/// What is known of the ground when its scale is chosen.
struct ScaleRange {
  float lowest = 0, highest = 0;             ///< m, of the original ground, relative to the surface's origin
  float largest_sinkage = 0;                 ///< m, up or down, so far
  std::span<const Material> materials = {};  ///< the first kScaleStops have colours of their own, then they repeat
};

/// The scale of `color`. Ranges are round, so that they stay while the ground moves a little.
ColorScale color_scale(ColorBy color, const ScaleRange& range);

}  // namespace divot::viewer
