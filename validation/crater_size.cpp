// Radius and depth of craters against charge: by soil as TM 5-855-1 has them, and by eq. 10.
#include <fmt/format.h>

#include <cmath>

#include "divot/blast.h"
#include "validation/craters.h"
#include "validation/data.h"
#include "validation/families.h"
#include "validation/figures.h"
#include "validation/simulate.h"

namespace divot::validation {
namespace {

using Style = cli::CurveChart::Series::Style;

constexpr double kTolerance = 0.15, kEq10Tolerance = 0.10;
constexpr double kCharges_t[] = {0.001, 0.1, 10, 1000, 5000};
constexpr double kEq10_t[] = {0.25, 1, 10, 100, 1000, 5000};

Experiment in_soil(const ScaledCrater& soil, int color, double yield) {
  const double scale = std::cbrt(yield * kTon);
  const std::string name = fmt::format("crater_size/{}/{:g}t", soil.material, yield);
  const std::string source = fmt::format("{}, {}", kManual, soil.medium);
  return {{{name + "/radius", source, "crater radius over cube root of charge", "m/kg^(1/3)", soil.radius, kTolerance},
           {name + "/depth", source, "crater depth over cube root of charge", "m/kg^(1/3)", soil.depth, kTolerance}},
          [=]() -> Result<Outcome> {
            const auto world = explode(bomb_scene(soil.material, yield * kTon, 0, soil.radius * scale));
            if (!world) return tl::unexpected(world.error());
            const Crater crater = world->craters().front();
            return Outcome{{crater.width / 2 / scale, crater.depth / scale},
                           {{kCraterSize, {soil.medium, Style::dots, color, {{yield * kTon, crater.width}}}}}};
          }};
}

// The law itself, for the figure: diameters from the least charge to the largest.
Experiment law(const ScaledCrater& soil, int color) {
  return {{}, [=]() -> Result<Outcome> {
            Curve curve{kCraterSize, {fmt::format("{}, measured", soil.medium), Style::line, color, {}}};
            for (const double yield : {kCharges_t[0], kCharges_t[4]})
              curve.series.points.emplace_back(yield * kTon, 2 * soil.radius * std::cbrt(yield * kTon));
            return Outcome{{}, {curve}};
          }};
}

Experiment by_eq10(Blast model, double yield) {
  const double width = blast_source(yield).crater_width;
  const bool scaled = model == Blast::scaled;
  return {{{fmt::format("crater_size/{}/{:g}t/width", scaled ? "eq10" : "paper_blast", yield),
            "Dvorak & Drahansky (2008), eq. 10",
            fmt::format("crater width, blast = \"{}\"", scaled ? "scaled" : "paper"), "m", width, kEq10Tolerance}},
          [=]() -> Result<Outcome> {
            // As coarse as the paper's grid: eleven spacings across.
            Scene scene = bomb_scene("paper", yield * kTon, 0, width / 2, 6);
            scene.solver.blast = model;
            const auto world = explode(scene);
            if (!world) return tl::unexpected(world.error());
            return Outcome{{world->craters().front().width}};
          }};
}

// Shots as they were measured, for the figure.
Experiment measured(std::vector<MeasuredCrater> craters) {
  return {{}, [craters = std::move(craters)]() -> Result<Outcome> {
            Curve surface{kCraterSize, {"single shots at the surface", Style::marks, 8, {}}};
            Curve buried{kCraterSize, {"single shots, buried", Style::marks, 5, {}}};
            for (const MeasuredCrater& crater : craters)
              if (crater.kind == "chemical")
                (crater.height < 0 ? buried : surface).series.points.emplace_back(crater.charge, crater.diameter);
            return Outcome{{}, {surface, buried}};
          }};
}

}  // namespace

Result<std::vector<Experiment>> crater_size(const Places& places) {
  auto craters = measured_craters(places.data);
  if (!craters) return tl::unexpected(craters.error());
  std::vector<Experiment> experiments;
  int color = 1;
  for (const ScaledCrater& soil : kScaledCraters) {
    experiments.push_back(law(soil, color));
    for (const double yield : kCharges_t) experiments.push_back(in_soil(soil, color, yield));
    ++color;
  }
  for (const double yield : kEq10_t) experiments.push_back(by_eq10(Blast::scaled, yield));
  experiments.push_back(by_eq10(Blast::paper, 5000));
  experiments.push_back(measured(std::move(*craters)));
  return experiments;
}

}  // namespace divot::validation
