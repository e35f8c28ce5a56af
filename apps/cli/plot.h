#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "divot/errors.h"

namespace divot::cli {

/// Values side by side: one group for each label, and in it one bar for each series.
struct BarChart {
  std::string name;  ///< of the file, without ending
  std::string title;
  std::string y_label;
  std::vector<std::string> labels;  ///< [group]
  struct Series {
    std::string name;
    std::vector<double> values;  ///< [group] > 0
  };
  std::vector<Series> series;
  bool log_scale = false;
};

/// Values over values: lines, points and marks with their names beside them.
struct CurveChart {
  std::string name;  ///< of the file, without ending
  std::string title, x_label, y_label;
  bool log_x = false, log_y = false;
  struct Series {
    /// A curve, a broken one, one with its points on it, filled points, empty ones.
    enum class Style : std::uint8_t { line, dashes, joined, dots, marks };
    std::string name;  ///< empty: not in the legend
    Style style = Style::line;
    int color = 0;                                  ///< series that belong together share one, >= 0
    std::vector<std::pair<double, double>> points;  ///< x, y; above 0 where the axis is logarithmic
  };
  std::vector<Series> series;  ///< at least one
};

/// Draws a chart with gnuplot as a PNG file. Fails when gnuplot is not installed or refuses.
Result<void> write_png(const BarChart& chart, const std::string& path);
Result<void> write_png(const CurveChart& chart, const std::string& path);

}  // namespace divot::cli
