#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "divot/errors.h"

namespace divot::viewer {

/// A picture in memory.
struct Image {
  int width = 0, height = 0;           ///< pixels
  std::vector<std::uint8_t> rgb = {};  ///< [3 * (row * width + column) + channel], row 0 at the top

  friend bool operator==(const Image&, const Image&) = default;
};

/// Writes `image` as PNG, first to a temporary name beside `path` and then renamed, so that nobody sees half a picture.
/// Fails when the picture is empty or the file cannot be written. [O(pixels)]
Result<void> write_png(const Image& image, const std::string& path);

/// How pictures are laid out on one sheet.
struct SheetLayout {
  int columns = 1;  ///< >= 1; pictures fill row after row, the last is centred
  int margin = 8;   ///< pixels of white around each picture, >= 0
};

/// Places pictures side by side on white; each cell is as large as the largest picture. Fails when there is nothing to
/// place or the layout is out of range. [O(pixels)]
Result<Image> contact_sheet(std::span<const Image> images, const SheetLayout& layout);

/// `contact_sheet` written as PNG.
Result<void> write_contact_sheet(std::span<const Image> images, const SheetLayout& layout, const std::string& path);

}  // namespace divot::viewer
