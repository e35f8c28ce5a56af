#pragma once

#include <array>
#include <functional>
#include <string>

#include "divot/errors.h"

// What all plots share: how they look, and the program that draws them.
namespace divot::cli::gnuplot {

/// Colours of series, in turn.
inline constexpr std::array kColors = {"#8b97a5", "#e09f3e", "#2a6fb0", "#5f8d4e", "#9e2a2b", "#7a5c99", "#3fa7a3",
                                       "#b5651d", "#444b54", "#d06ba0", "#8a8f2f", "#6fa8dc", "#c97b63"};
inline constexpr const char* kInk = "#30363d";  ///< of text and axes

/// Text between double quotes of a script.
std::string quoted(const std::string& text);

/// What a picture is called and what its axes hold. Empty labels are left out.
struct Titles {
  std::string title, x_label, y_label;
};

/// How every script begins: a PNG of that size at `path`, with its titles.
std::string opening(const std::string& path, int width, int height, const Titles& titles);

/// Draws a PNG file that appears whole or not at all. `script` is asked for the script that draws into a path. Fails
/// when gnuplot is not installed or refuses.
Result<void> draw(const std::string& path, const std::function<std::string(const std::string& path)>& script);

}  // namespace divot::cli::gnuplot
