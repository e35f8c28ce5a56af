// Balls dropped on dry sand: depth goes with the cube root of the total drop and the square root of the ball's density.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "validation/families.h"
#include "validation/figures.h"
#include "validation/simulate.h"

namespace divot::validation {
namespace {

using Style = cli::CurveChart::Series::Style;
using Points = std::vector<std::pair<double, double>>;

constexpr const char* kSource = "Uehara et al. (2003), Ambroso et al. (2005)";
constexpr double kTolerance = 0.10;
constexpr double kSteel = 7800, kStone = 2500;  // kg/m^3
constexpr double kMost = 1.2;                   // m, ground on each side of the largest ball's middle, in diameters

// How deep a ball goes that is dropped from `height` above the sand, m.
Result<double> depth(double height, double density, double diameter) {
  const double radius = diameter / 2, spacing = diameter / 12;
  Scene scene = flat("dry_sand", 2 * static_cast<int>(12 * kMost) + 1, spacing);
  scene.dt = 1.0 / 250;
  scene.bodies = {{.name = "ball",
                   .shape = Sphere{.radius = radius},
                   .mass = density * 4.0 / 3 * std::numbers::pi * radius * radius * radius,
                   .position = {0.3 * spacing, 0.1 * spacing, height},
                   .above_ground = true,
                   .restitution = 0}};
  const auto world = run(scene, std::sqrt(2 * height / kGravity) + 0.3);
  if (!world) return tl::unexpected(world.error());
  return world->bodies().front().max_sinkage;
}

// The drop from the ball's lowest point at rest in the air to where it ends is what counts: the height above the ground
// that leaves `total`, and the depth.
Result<double> depth_of_total(double total, double density, double diameter) {
  double deep = 0;
  for (int pass = 0; pass < 2; ++pass) {
    const auto now = depth(std::max(0.0, total - deep), density, diameter);
    if (!now) return now;
    deep = *now;
  }
  return deep;
}

// Exponents by one ball: the laboratory's, and a boulder.
struct Ball {
  const char* name;
  double diameter, density;
  int color;
};
constexpr Ball kBalls[] = {{"5cm", 0.05, kSteel, 1}, {"50cm", 0.5, kStone, 2}};

Experiment by_height(const Ball& ball) {
  return {{{fmt::format("drop/{}/height", ball.name), kSource,
            "exponent of depth over total drop, 0.1 to 1.6 m above ground", "1", 1.0 / 3, kTolerance}},
          [=]() -> Result<Outcome> {
            Points points;
            for (const double height : {0.1, 0.2, 0.4, 0.8, 1.6}) {
              const auto deep = depth(height, ball.density, ball.diameter);
              if (!deep) return tl::unexpected(deep.error());
              points.emplace_back(height + *deep, *deep);
            }
            Curve simulated{
                kDrop,
                {fmt::format("{} across, {:g} kg/m³", ball.name, ball.density), Style::dots, ball.color, points}};
            Curve law{kDrop, {"H^(1/3) (Uehara et al.)", Style::dashes, ball.color, {}}};
            const auto [h, d] = points[2];
            for (const double drop : {0.1, 2.0}) law.series.points.emplace_back(drop, d * std::cbrt(drop / h));
            return Outcome{{fitted_exponent(points)}, {simulated, law}};
          }};
}

Experiment by_density(const Ball& ball) {
  return {{{fmt::format("drop/{}/density", ball.name), kSource,
            "exponent of depth over density at 0.8 m of total drop, 1200 to 15000 kg/m^3", "1", 0.5, kTolerance}},
          [=]() -> Result<Outcome> {
            Points points;
            for (const double density : {1200.0, 2500.0, 7800.0, 15000.0}) {
              const auto deep = depth_of_total(0.8, density, ball.diameter);
              if (!deep) return tl::unexpected(deep.error());
              points.emplace_back(density, *deep);
            }
            return Outcome{{fitted_exponent(points)}};
          }};
}

Experiment by_diameter() {
  return {{{"drop/diameter", kSource, "exponent of depth over diameter at 0.8 m of total drop, 0.025 to 0.4 m, steel",
            "1", 2.0 / 3, kTolerance}},
          []() -> Result<Outcome> {
            Points points;
            for (const double diameter : {0.025, 0.1, 0.4}) {
              const auto deep = depth_of_total(0.8, kSteel, diameter);
              if (!deep) return tl::unexpected(deep.error());
              points.emplace_back(diameter, *deep);
            }
            return Outcome{{fitted_exponent(points)}};
          }};
}

}  // namespace

Result<std::vector<Experiment>> drop(const Places&) {
  std::vector<Experiment> experiments;
  for (const Ball& ball : kBalls) {
    experiments.push_back(by_height(ball));
    experiments.push_back(by_density(ball));
  }
  experiments.push_back(by_diameter());
  return experiments;
}

}  // namespace divot::validation
