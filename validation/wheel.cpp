// A rigid wheel that is towed or driven: sinkage, rolling resistance and drawbar pull by Bekker and by Wong & Reece.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "validation/data.h"
#include "validation/families.h"
#include "validation/figures.h"
#include "validation/simulate.h"
#include "validation/wheel_rig.h"

namespace divot::validation {
namespace {

using Style = cli::CurveChart::Series::Style;

constexpr double kTowed = 0.10, kDriven = 0.20;  // tolerances

struct Forces {
  double up = 0, pull = 0, torque = 0;  // N, N m
};

// [Wong & Reece 1967] stresses along the rim of a wheel that has sunk by z, integrated: Bekker's pressure before the
// axle, shear of the displacement that a point of the rim has made. Behind it the soil comes back by its elastic part.
Forces integrated(const MeasuredSoil& soil, double elastic_stiffness, const Rig& rig, double z, double slip) {
  constexpr int kParts = 2000;
  const double r = rig.radius, b = rig.width, k = soil.kc / b + soil.kphi, most = k * std::pow(z, soil.n);
  const double front = std::acos(1 - z / r), back = std::acos(1 - most / elastic_stiffness / r);
  const double part = (front + back) / kParts, grip = std::tan(soil.friction_angle_deg * std::numbers::pi / 180);
  Forces sum;
  for (int i = 0; i < kParts; ++i) {
    const double angle = front - (i + 0.5) * part, depth = z - r * (1 - std::cos(angle));
    const double pressure = angle > 0 ? k * std::pow(depth, soil.n) : most - elastic_stiffness * (z - depth);
    const double j = r * ((front - angle) - (1 - slip) * (std::sin(front) - std::sin(angle)));
    const double shear =
        (soil.cohesion + pressure * grip) * std::copysign(1 - std::exp(-std::abs(j) / soil.shear_modulus), j);
    sum.up += b * r * part * (pressure * std::cos(angle) + shear * std::sin(angle));
    sum.pull += b * r * part * (shear * std::cos(angle) - pressure * std::sin(angle));
    sum.torque += b * r * part * r * shear;
  }
  return sum;
}

// At which it carries the load.
double sinkage(const MeasuredSoil& soil, double elastic_stiffness, const Rig& rig, double slip) {
  return solve(1e-5, 0.8 * rig.radius,
               [&](double z) { return integrated(soil, elastic_stiffness, rig, z, slip).up - rig.load; });
}

Forces under_load(const MeasuredSoil& soil, double elastic_stiffness, const Rig& rig, double slip) {
  return integrated(soil, elastic_stiffness, rig, sinkage(soil, elastic_stiffness, rig, slip), slip);
}

Experiment towed(const char* name, const MeasuredSoil& soil, const Rig& rig) {
  const Material ground = material_of(soil);
  // What is towed turns freely: at the skid at which no torque is left.
  const double skid =
      solve(-0.9, 0.3, [&](double slip) { return under_load(soil, ground.elastic_stiffness, rig, slip).torque; });
  const double drag = -under_load(soil, ground.elastic_stiffness, rig, skid).pull / rig.load;
  return {{{fmt::format("wheel/{}/towed_sinkage", name),
            fmt::format("Bekker (1969), Wong & Reece (1967); soil: {}", soil.source),
            fmt::format("sinkage of a towed wheel, {:g} kN", rig.load / 1000), "m",
            sinkage(soil, ground.elastic_stiffness, rig, skid), kTowed},
           {fmt::format("wheel/{}/resistance", name), fmt::format("Wong & Reece (1967); soil: {}", soil.source),
            fmt::format("rolling resistance over load, {:g} kN", rig.load / 1000), "1", drag, kTowed}},
          [=]() -> Result<Outcome> {
            const auto passes = run_rig(ground, rig);
            if (!passes) return tl::unexpected(passes.error());
            return Outcome{{passes->front().sinkage, -passes->front().pull / rig.load}};
          }};
}

Experiment driven(const char* name, const MeasuredSoil& soil, Rig rig, double slip, int color) {
  const Material ground = material_of(soil);
  rig.driven = true, rig.slip = slip;
  const double pull = under_load(soil, ground.elastic_stiffness, rig, slip).pull / rig.load;
  return {{{fmt::format("wheel/{}/drawbar_{:g}", name, 100 * slip),
            fmt::format("Wong & Reece (1967), Janosi & Hanamoto (1961); soil: {}", soil.source),
            fmt::format("drawbar pull over load at {:g} % slip, {:g} kN", 100 * slip, rig.load / 1000), "1", pull,
            kDriven}},
          [=]() -> Result<Outcome> {
            const auto passes = run_rig(ground, rig);
            if (!passes) return tl::unexpected(passes.error());
            const double simulated = passes->front().pull / rig.load;
            Curve law{kDrawbar, {"", Style::line, color, {}}};
            // Every experiment draws the part of the line round its own slip.
            for (const double near : {0.75, 1.0, 1.25})
              law.series.points.emplace_back(
                  100 * near * slip, under_load(soil, ground.elastic_stiffness, rig, near * slip).pull / rig.load);
            return Outcome{{simulated}, {law, {kDrawbar, {name, Style::dots, color, {{100 * slip, simulated}}}}}};
          }};
}

}  // namespace

Result<std::vector<Experiment>> wheel(const Places& places) {
  const auto soils = measured_soils(places.data);
  if (!soils) return tl::unexpected(soils.error());
  struct Soil {
    const char *name, *terrain;
    double moisture, load;
  };
  constexpr Soil kSoils[] = {{"dry_sand", "Dry sand (LLL)", 0, 3000},
                             {"lete_sand", "LETE sand (Wong)", 0, 12000},
                             {"sandy_loam", "Sandy loam (LLL)", 15, 6000},
                             {"mud", "Sandy loam (Hanamoto)", 32, 1000}};
  std::vector<Experiment> experiments;
  int color = 0;
  for (const Soil& soil : kSoils) {
    const auto measured = find_soil(*soils, soil.terrain, soil.moisture);
    if (!measured) return tl::unexpected(measured.error());
    const Rig rig{.load = soil.load};
    experiments.push_back(towed(soil.name, *measured, rig));
    for (const double slip : {0.1, 0.2, 0.3, 0.5})
      experiments.push_back(driven(soil.name, *measured, rig, slip, color));
    ++color;
  }
  return experiments;
}

}  // namespace divot::validation
