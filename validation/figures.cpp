#include "validation/figures.h"

#include <algorithm>

namespace divot::validation {
namespace {

const std::vector<cli::CurveChart>& empty_figures() {
  static const std::vector<cli::CurveChart> kFigures = {
      {.name = kCraterSize,
       .title = "Crater diameter against charge: lines measured, dots simulated",
       .x_label = "charge, kg of TNT",
       .y_label = "apparent diameter, m",
       .log_x = true,
       .log_y = true},
      {.name = kCraterProfile,
       .title = "Profile of the crater of a ton of TNT at the surface",
       .x_label = "distance from ground zero over the crater's radius",
       .y_label = "height over the crater's depth"},
      {.name = kPlate,
       .title = "Pressure under a plate against sinkage: lines by Bekker, dots simulated",
       .x_label = "sinkage, m",
       .y_label = "pressure, kPa",
       .log_x = true,
       .log_y = true},
      {.name = kDrawbar,
       .title = "Drawbar pull of a rigid wheel against slip: lines integrated, dots simulated",
       .x_label = "slip, %",
       .y_label = "drawbar pull over load"},
      {.name = kDrop,
       .title = "Penetration of dropped balls into dry sand",
       .x_label = "total drop, m",
       .y_label = "depth, m",
       .log_x = true,
       .log_y = true},
  };
  return kFigures;
}

}  // namespace

std::vector<cli::CurveChart> figures(const std::vector<Curve>& curves) {
  std::vector<cli::CurveChart> charts;
  for (cli::CurveChart chart : empty_figures()) {
    for (const Curve& curve : curves) {
      if (curve.figure != chart.name || curve.series.points.empty()) continue;
      const auto same = std::find_if(chart.series.begin(), chart.series.end(), [&](const auto& series) {
        return series.name == curve.series.name && series.style == curve.series.style &&
               series.color == curve.series.color;
      });
      if (same == chart.series.end())
        chart.series.push_back(curve.series);
      else
        same->points.insert(same->points.end(), curve.series.points.begin(), curve.series.points.end());
    }
    if (!chart.series.empty()) charts.push_back(std::move(chart));
  }
  return charts;
}

}  // namespace divot::validation
