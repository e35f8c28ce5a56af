// A sphere set down gently: Bekker's pressure integrated over its underside carries it.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "validation/data.h"
#include "validation/families.h"
#include "validation/simulate.h"

namespace divot::validation {
namespace {

constexpr double kTolerance = 0.10;

struct Ball {
  const char* name;
  double radius, mass, spacing;
};

// W = 2 pi k [(R - z) z^(n+1)/(n+1) + z^(n+2)/(n+2)], k = kc/b + kphi, b the radius of the patch at that depth.
double load(const MeasuredSoil& soil, double radius, double z) {
  const double patch = std::sqrt(z * (2 * radius - z));
  return 2 * std::numbers::pi * (soil.kc / patch + soil.kphi) *
         ((radius - z) * std::pow(z, soil.n + 1) / (soil.n + 1) + std::pow(z, soil.n + 2) / (soil.n + 2));
}

Experiment at_rest(const char* soil_name, const MeasuredSoil& soil, const Ball& ball) {
  const double expected =
      solve(1e-6, ball.radius, [&](double z) { return load(soil, ball.radius, z) - ball.mass * kGravity; });
  return {{{fmt::format("sphere/{}/{}", soil_name, ball.name), fmt::format("Bekker (1969); soil: {}", soil.source),
            fmt::format("sinkage, {:g} kg, {:g} m in radius, spacing {:g} m", ball.mass, ball.radius, ball.spacing),
            "m", expected, kTolerance}},
          [=]() -> Result<Outcome> {
            Scene scene = flat("measured", 2 * static_cast<int>(1.5 * ball.radius / ball.spacing) + 1, ball.spacing);
            scene.materials = {material_of(soil)};
            scene.bodies = {{.name = "ball",
                             .shape = Sphere{.radius = ball.radius},
                             .mass = ball.mass,
                             .position = {0.3 * ball.spacing, 0.1 * ball.spacing, 0},
                             .above_ground = true}};
            const auto world = run_to_rest(scene);
            if (!world) return tl::unexpected(world.error());
            return Outcome{{world->bodies().front().sinkage}};
          }};
}

}  // namespace

Result<std::vector<Experiment>> sphere(const Places& places) {
  const auto soils = measured_soils(places.data);
  if (!soils) return tl::unexpected(soils.error());
  struct Soil {
    const char *name, *terrain;
    double moisture;
    std::vector<Ball> balls;
  };
  const std::vector<Soil> chosen = {
      {"dry_sand",
       "Dry sand (LLL)",
       0,
       {{"light", 1, 2000, 0.05},
        {"heavy", 1, 20000, 0.05},
        {"coarse", 1, 20000, 0.1},
        {"fine", 1, 20000, 0.025},
        {"small", 0.1, 20, 0.01}}},
      {"lete_sand", "LETE sand (Wong)", 0, {{"light", 1, 4000, 0.05}, {"heavy", 1, 40000, 0.05}}},
      {"sandy_loam", "Sandy loam (LLL)", 15, {{"light", 1, 4000, 0.05}, {"heavy", 1, 40000, 0.05}}},
      {"clay", "Clayey soil (Thailand)", 55, {{"light", 1, 4000, 0.05}, {"heavy", 1, 40000, 0.05}}},
      {"mud", "Sandy loam (Hanamoto)", 32, {{"light", 1, 1000, 0.05}, {"heavy", 1, 10000, 0.05}}},
      {"snow", "Snow (U.S.)", 0, {{"light", 1, 500, 0.05}, {"heavy", 1, 4000, 0.05}}},
      {"lunar", "Lunar nominal soil", 0, {{"light", 0.25, 30, 0.025}, {"heavy", 0.25, 300, 0.025}}},
  };
  std::vector<Experiment> experiments;
  for (const Soil& soil : chosen) {
    const auto measured = find_soil(*soils, soil.terrain, soil.moisture);
    if (!measured) return tl::unexpected(measured.error());
    for (const Ball& ball : soil.balls) experiments.push_back(at_rest(soil.name, *measured, ball));
  }
  return experiments;
}

}  // namespace divot::validation
