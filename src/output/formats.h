#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "divot/errors.h"
#include "output/frame.h"

namespace divot::output {

/// A file of a series and the time it shows, s.
struct SeriesEntry {
  std::string file;  ///< without its folder
  double time = 0;
};

/// One way to write the ground. Everything that knows of formats (scene files, their page, the recorder) reads the
/// table in formats.cpp: a new format is a row there.
struct Format {
  const char* name;     ///< in `output.formats`, and the end of the file's name
  const char* meaning;  ///< for docs/scene-format.md
  bool raster = false;  ///< written from Frame::raster, and left out where the terrain has none
  Result<void> (*write)(const std::string& path, const Frame& frame) = nullptr;
  /// The file that lists all frames, written anew after each; nullptr where the format has none.
  const char* series_name = nullptr;
  Result<void> (*write_series)(const std::string& path, std::span<const SeriesEntry> frames) = nullptr;
};

/// All of them, in the order of the docs.
std::span<const Format> formats();

/// Their names, in the same order.
std::span<const char* const> format_names();

/// The format of that name, which must be there.
const Format& format(std::string_view name);

}  // namespace divot::output
