// A plate set down gently: soil carries it by Bekker's pressure at the depth it came to.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/data.h"
#include "validation/families.h"
#include "validation/figures.h"
#include "validation/simulate.h"

namespace divot::validation {
namespace {

using Style = cli::CurveChart::Series::Style;

constexpr double kTolerance = 0.05;
constexpr double kLength = 0.5, kHigh = 0.2;  // m

struct Plate {
  const char* name;
  double width, mass;  // m, its smaller side; kg
};

double pressure_at(const MeasuredSoil& soil, double width, double z) {
  return (soil.kc / width + soil.kphi) * std::pow(z, soil.n);
}

Experiment pressed(const char* soil_name, const MeasuredSoil& soil, const Plate& plate, int color) {
  const double pressure = plate.mass * kGravity / (kLength * plate.width);
  return {
      {{fmt::format("plate/{}/{}", soil_name, plate.name), fmt::format("Bekker (1969); soil: {}", soil.source),
        fmt::format("pressure at the sinkage it comes to, {:g} m x {:g} m, {:g} kg", kLength, plate.width, plate.mass),
        "kPa", pressure / 1000, kTolerance}},
      [=]() -> Result<Outcome> {
        constexpr double kSpacing = 0.04;
        Scene scene = flat("measured", 41, kSpacing);
        scene.materials = {material_of(soil)};
        scene.bodies = {{.name = "plate",
                         .shape = Box{{kLength, plate.width, kHigh}},
                         .mass = plate.mass,
                         .position = {0.3 * kSpacing, 0.1 * kSpacing, 0},
                         .above_ground = true}};
        const auto world = run_to_rest(scene);
        if (!world) return tl::unexpected(world.error());
        const double z = 0.5 * kHigh - world->bodies().front().position.z;
        Curve simulated{kPlate, {soil_name, Style::dots, color, {{z, pressure / 1000}}}};
        Curve law{kPlate, {"", Style::line, color, {}}};
        for (const double share : {0.5, 1.0, 2.0})
          law.series.points.emplace_back(share * z, pressure_at(soil, plate.width, share * z) / 1000);
        return Outcome{{pressure_at(soil, plate.width, std::max(z, 0.0)) / 1000}, {simulated, law}};
      }};
}

}  // namespace

Result<std::vector<Experiment>> plate(const Places& places) {
  const auto soils = measured_soils(places.data);
  if (!soils) return tl::unexpected(soils.error());
  struct Soil {
    const char *name, *terrain;
    double moisture;
    std::vector<Plate> plates;
  };
  const std::vector<Soil> chosen = {
      {"dry_sand", "Dry sand (LLL)", 0, {{"light", 0.3, 300}, {"heavy", 0.3, 1200}, {"narrow", 0.12, 300}}},
      {"lete_sand", "LETE sand (Wong)", 0, {{"light", 0.3, 800}, {"heavy", 0.3, 4000}, {"narrow", 0.12, 800}}},
      {"sandy_loam", "Sandy loam (LLL)", 15, {{"light", 0.3, 600}, {"heavy", 0.3, 2500}}},
      {"clay", "Clayey soil (Thailand)", 55, {{"light", 0.3, 600}, {"heavy", 0.3, 2500}}},
      {"mud", "Sandy loam (Hanamoto)", 32, {{"light", 0.3, 100}, {"heavy", 0.3, 250}}},
      {"snow", "Snow (U.S.)", 0, {{"light", 0.3, 100}, {"heavy", 0.3, 400}}},
      {"lunar", "Lunar nominal soil", 0, {{"light", 0.3, 200}, {"heavy", 0.3, 800}}},
  };
  std::vector<Experiment> experiments;
  int color = 0;
  for (const Soil& soil : chosen) {
    const auto measured = find_soil(*soils, soil.terrain, soil.moisture);
    if (!measured) return tl::unexpected(measured.error());
    for (const Plate& one : soil.plates) experiments.push_back(pressed(soil.name, *measured, one, color));
    ++color;
  }
  return experiments;
}

}  // namespace divot::validation
