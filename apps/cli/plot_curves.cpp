#include <fmt/format.h>

#include "cli/gnuplot.h"
#include "cli/plot.h"

namespace divot::cli {
namespace {

using Series = CurveChart::Series;

// One block of data for each series.
std::string data_blocks(const CurveChart& chart) {
  std::string out;
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    out += fmt::format("$data{} << end_of_data\n", k);
    for (const auto& [x, y] : chart.series[k].points) out += fmt::format("{:.9g} {:.9g}\n", x, y);
    out += "end_of_data\n";
  }
  return out;
}

std::string drawn_as(const Series& series) {
  const char* color = gnuplot::kColors[static_cast<std::size_t>(series.color) % gnuplot::kColors.size()];
  switch (series.style) {
    case Series::Style::line:
      return fmt::format("with lines linewidth 2 linecolor rgb '{}'", color);
    case Series::Style::dashes:
      return fmt::format("with lines dashtype 2 linewidth 1.5 linecolor rgb '{}'", color);
    case Series::Style::joined:
      return fmt::format("with linespoints linewidth 2 pointtype 7 linecolor rgb '{}'", color);
    case Series::Style::dots:
      return fmt::format("with points pointtype 7 pointsize 1.1 linecolor rgb '{}'", color);
    case Series::Style::marks:
      return fmt::format("with points pointtype 4 pointsize 1.6 linewidth 2 linecolor rgb '{}'", color);
  }
  return {};
}

std::string plot_line(const CurveChart& chart) {
  std::string text = "plot ";
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    const Series& series = chart.series[k];
    const std::string title = series.name.empty() ? "notitle" : "title " + gnuplot::quoted(series.name);
    text += fmt::format("{}$data{} using 1:2 {} {}", k == 0 ? "" : ", ", k, drawn_as(series), title);
  }
  return text + "\n";
}

std::string script(const CurveChart& chart, const std::string& path) {
  std::string out = gnuplot::opening(path, 1200, 720, {chart.title, chart.x_label, chart.y_label});
  out += "set grid linecolor rgb '#d8dde3' linetype 1\nset key outside right top reverse Left samplen 2\n";
  if (chart.log_x) out += "set logscale x\nset format x '%g'\n";
  if (chart.log_y) out += "set logscale y\nset format y '%g'\n";
  return out + data_blocks(chart) + plot_line(chart);
}

}  // namespace

Result<void> write_png(const CurveChart& chart, const std::string& path) {
  return gnuplot::draw(path, [&](const std::string& file) { return script(chart, file); });
}

}  // namespace divot::cli
