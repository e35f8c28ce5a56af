#include "viewer/color_scale.h"

#include <algorithm>
#include <cmath>

namespace divot::viewer {
namespace {

using Stops = std::array<ColorScale::Rgb, kScaleStops>;

// Even steps of lightness, so that a print in grey reads the same.
constexpr Stops kHeight = {{{0.13f, 0.29f, 0.40f},
                            {0.22f, 0.50f, 0.45f},
                            {0.55f, 0.66f, 0.38f},
                            {0.84f, 0.75f, 0.46f},
                            {0.97f, 0.94f, 0.84f}}};
constexpr Stops kSlope = {{{0.10f, 0.10f, 0.25f},
                           {0.42f, 0.15f, 0.43f},
                           {0.75f, 0.27f, 0.35f},
                           {0.95f, 0.55f, 0.25f},
                           {0.99f, 0.92f, 0.62f}}};
// Raised, untouched, sunk.
constexpr Stops kSinkage = {{{0.70f, 0.22f, 0.12f},
                             {0.93f, 0.62f, 0.42f},
                             {0.90f, 0.90f, 0.86f},
                             {0.45f, 0.65f, 0.83f},
                             {0.10f, 0.30f, 0.62f}}};
constexpr Stops kAwake = {{{0.42f, 0.44f, 0.46f},
                           {0.55f, 0.47f, 0.40f},
                           {0.70f, 0.48f, 0.28f},
                           {0.86f, 0.47f, 0.16f},
                           {1.00f, 0.45f, 0.05f}}};
// Told apart also by those who see no red or green [Okabe & Ito 2008].
constexpr Stops kMaterial = {{{0.90f, 0.62f, 0.00f},
                              {0.34f, 0.71f, 0.91f},
                              {0.00f, 0.62f, 0.45f},
                              {0.94f, 0.89f, 0.26f},
                              {0.80f, 0.47f, 0.65f}}};

constexpr float kSteepest = 60;         // degrees
constexpr float kLeastSinkage = 0.01f;  // m, of a scale

// The next of 1, 2, 5, 10, 20 ... times a power of ten that is not less than `x`.
float round_up(float x) {
  const float power = std::pow(10.0f, std::floor(std::log10(x)));
  for (const float step : {1.0f, 2.0f, 5.0f}) {
    if (x <= step * power * 1.0001f) return step * power;
  }
  return 10 * power;
}

ColorScale material_scale(std::span<const Material> materials) {
  ColorScale scale{.stops = kMaterial, .low = 0, .high = kScaleStops - 1, .title = "material"};
  for (const Material& material : materials.first(std::min(materials.size(), kScaleStops))) {
    scale.labels.push_back(material.name);
  }
  return scale;
}

}  // namespace

ColorScale color_scale(ColorBy color, const ScaleRange& range) {
  const float sinkage = round_up(std::max(range.largest_sinkage, kLeastSinkage));
  // Flat ground gets a scale as wide as what has moved on it.
  const float middle = (range.lowest + range.highest) / 2;
  const float half = std::max((range.highest - range.lowest) / 2, sinkage);
  switch (color) {
    case ColorBy::height:
      return {.stops = kHeight, .low = middle - half, .high = middle + half, .title = "height (m)"};
    case ColorBy::sinkage:
      return {.stops = kSinkage, .low = -sinkage, .high = sinkage, .title = "sinkage (m)"};
    case ColorBy::slope:
      return {.stops = kSlope, .low = 0, .high = kSteepest, .title = "slope (degrees)"};
    case ColorBy::awake:
      return {.stops = kAwake, .low = 0, .high = 1, .title = "particles", .labels = {"asleep", "", "", "", "awake"}};
    case ColorBy::material:
      return material_scale(range.materials);
    case ColorBy::natural:
      break;
  }
  return {};
}

}  // namespace divot::viewer
