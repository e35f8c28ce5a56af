#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/gnuplot.h"
#include "cli/plot.h"

namespace divot::cli {
namespace {

constexpr double kGap = 0.8;  // between groups, in bars

// Two digits, more before the point: 12, 1.2, 0.12.
std::string value_text(double value) {
  const int decimals = value >= 10 ? 0 : value >= 1 ? 1 : value >= 0.1 ? 2 : 3;
  return fmt::format("{:.{}f}", value, decimals);
}

// A row for each group: label, then value and text of each series.
std::string data_block(const BarChart& chart) {
  std::string out = "$data << end_of_data\n";
  for (std::size_t group = 0; group < chart.labels.size(); ++group) {
    out += gnuplot::quoted(chart.labels[group]);
    for (const BarChart::Series& series : chart.series)
      out += fmt::format(" {} {}", series.values[group], value_text(series.values[group]));
    out += '\n';
  }
  return out + "end_of_data\n";
}

// Bars, over each its value, and below each group its label: points without a mark, as an axis takes labels from a plot
// only.
std::string plot_line(const BarChart& chart) {
  const double width = 1 / (static_cast<double>(chart.series.size()) + kGap);
  std::string text = "plot $data using 0:2:xtic(1) with dots linecolor rgb 'white' notitle";
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    const double shift = width * (static_cast<double>(k) - (static_cast<double>(chart.series.size()) - 1) / 2);
    const std::size_t column = 2 + 2 * k;
    text +=
        fmt::format(", $data using ($0+{}):{}:({}) with boxes linecolor rgb '{}' title {}", shift, column, 0.94 * width,
                    gnuplot::kColors[k % gnuplot::kColors.size()], gnuplot::quoted(chart.series[k].name));
    text += fmt::format(", $data using ($0+{}):{}:{} with labels offset 0,0.55 font ',11' textcolor rgb '{}' notitle",
                        shift, column, column + 1, gnuplot::kInk);
  }
  return text + "\n";
}

// From the decade below the least value to some room over the largest, for its text and the key.
std::string y_range(const BarChart& chart) {
  double least = 1e300, largest = 0;
  for (const BarChart::Series& series : chart.series)
    for (const double value : series.values) least = std::min(least, value), largest = std::max(largest, value);
  if (!chart.log_scale) return fmt::format("set yrange [0:{}]\n", 1.15 * largest);
  return fmt::format("set logscale y\nset format y '%g'\nset yrange [{}:{}]\n",
                     std::pow(10, std::floor(std::log10(least))), 3 * largest);
}

std::string script(const BarChart& chart, const std::string& path) {
  std::string out = gnuplot::opening(path, 1200, 640, {.title = chart.title, .y_label = chart.y_label});
  out += "set xtics scale 0\nset grid ytics linecolor rgb '#d8dde3' linetype 1\n";
  out += "set key top right\nset style fill solid 1 noborder\n";
  out += fmt::format("set xrange [-0.5:{}]\n", static_cast<double>(chart.labels.size()) - 0.5);
  return out + y_range(chart) + data_block(chart) + plot_line(chart);
}

}  // namespace

Result<void> write_png(const BarChart& chart, const std::string& path) {
  return gnuplot::draw(path, [&](const std::string& file) { return script(chart, file); });
}

}  // namespace divot::cli
