#pragma once

#include <string>
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

/// Curves through points, both axes logarithmic.
struct LineChart {
  std::string name;  ///< of the file, without ending
  std::string title;
  std::string x_label, y_label;
  struct Series {
    std::string name;
    std::vector<double> x, y;  ///< [point] > 0
  };
  std::vector<Series> series;
};

/// Draws `chart` with gnuplot as a PNG file. Fails when gnuplot is not installed or refuses.
Result<void> write_png(const BarChart& chart, const std::string& path);
Result<void> write_png(const LineChart& chart, const std::string& path);

}  // namespace divot::cli
