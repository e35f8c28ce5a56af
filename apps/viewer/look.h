#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace divot::viewer {

/// What the ground's colours tell.
enum class ColorBy : std::uint8_t { natural, height, sinkage, slope, awake, material };

/// Their names, in order, as people write them.
inline constexpr std::array<std::string_view, 6> kColorByNames = {"natural", "height", "sinkage",
                                                                  "slope",   "awake",  "material"};

/// How much work a pixel is worth. `fast` is for software renderers: light per vertex, texture instead of noise, hard
/// shadows of the ground and analytic ones of balls.
enum class Quality : std::uint8_t { fast, fine };

/// Samples of a pixel, which smooth edges.
constexpr int samples_of(Quality quality) { return quality == Quality::fine ? 4 : 0; }

/// How a world is drawn. All of it can change from picture to picture.
struct Look {
  bool wireframe = false;  ///< hidden-line drawing instead of lit ground
  ColorBy color = ColorBy::natural;
  Quality quality = Quality::fine;
  bool particles = false;  ///< those awake, as points
  bool effects = false;    ///< flash and dust of explosions
  friend bool operator==(const Look&, const Look&) = default;
};

}  // namespace divot::viewer
