#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "cli/options.h"
#include "cli/plot.h"
#include "cli/scene_input.h"
#include "output/atomic_file.h"

namespace divot::cli {

/// Draws charts as PNG files into a folder, and says so. Fails where the folder cannot be made. What cannot be drawn is
/// told and no failure: numbers are worth having without their picture.
template <class Chart>
Result<void> write_charts(const std::vector<Chart>& charts, const std::string& folder) {
  if (charts.empty()) return {};
  if (const auto made = output::make_folder(folder); !made) return made;
  for (const Chart& chart : charts) {
    const std::string file = (std::filesystem::path(folder) / (chart.name + ".png")).string();
    if (const auto drawn = write_png(chart, file); drawn)
      fmt::print("plot: {}\n", file);
    else
      report(drawn.error(), kDone);
  }
  return {};
}

}  // namespace divot::cli
