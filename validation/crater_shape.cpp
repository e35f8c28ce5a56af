// What a crater of a ton of TNT at the surface looks like.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "validation/craters.h"
#include "validation/families.h"
#include "validation/figures.h"
#include "validation/simulate.h"

namespace divot::validation {
namespace {

using Style = cli::CurveChart::Series::Style;

constexpr int kRays = 36;
constexpr double kStride = 0.025;  // radii
constexpr int kStrides = 120;      // to three radii

// Mean height of the ground above the original over rays, by distance from ground zero in strides of `stride` m.
std::vector<double> mean_profile(const World& world, double stride) {
  const Vec3d middle = world.bombs().front().position;
  std::vector<double> heights;
  for (int k = 0; k <= kStrides; ++k) {
    double sum = 0;
    for (int ray = 0; ray < kRays; ++ray) {
      const double angle = 2 * std::numbers::pi * ray / kRays;
      sum += world.ground_height(middle.x + k * stride * std::cos(angle), middle.y + k * stride * std::sin(angle));
    }
    heights.push_back(sum / kRays);
  }
  return heights;
}

Experiment shape(const ScaledCrater& soil, int color) {
  const std::string name = fmt::format("crater_shape/{}/", soil.material);
  const char* glasstone = "Glasstone & Dolan (1977)";
  return {{between({name + "aspect", "surface bursts in soil", "depth over width", "1"}, 0.15, 0.30),
           between({name + "lip_height", "Glasstone & Dolan (1977): 0.25", "lip height over depth", "1"}, 0.15, 0.35),
           between({name + "lip_volume", "EPG, dry sand, surface bursts", "volume above over volume below ground", "1"},
                   0.15, 0.20),
           {name + "lip_radius", glasstone, "radius of the lip's crest over crater radius", "1", 1.25, 0.15},
           {name + "volume", glasstone, "volume over pi/2 R^2 depth", "1", 1, 0.15}},
          [=]() -> Result<Outcome> {
            const auto world = explode(bomb_scene(soil.material, kTon, 0, 10 * soil.radius, 20));
            if (!world) return tl::unexpected(world.error());
            const Crater crater = world->craters().front();
            const double radius = crater.width / 2;
            const std::vector<double> profile = mean_profile(*world, kStride * radius);
            const double crest =
                kStride * static_cast<double>(std::max_element(profile.begin(), profile.end()) - profile.begin());
            Curve curve{kCraterProfile, {fmt::format("{}, simulated", soil.medium), Style::line, color, {}}};
            for (std::size_t k = 0; k < profile.size(); ++k)
              curve.series.points.emplace_back(kStride * static_cast<double>(k), profile[k] / crater.depth);
            const SoilVolume soil_volume = world->soil_volume();
            return Outcome{{crater.depth / crater.width, crater.lip_height / crater.depth,
                            soil_volume.deposited / soil_volume.displaced, crest,
                            crater.volume / (std::numbers::pi / 2 * radius * radius * crater.depth)},
                           {curve}};
          }};
}

// What the figure compares with.
Experiment paraboloid() {
  return {{}, []() -> Result<Outcome> {
            Curve bowl{kCraterProfile, {"paraboloid (Glasstone & Dolan)", Style::dashes, 8, {}}};
            for (int k = 0; k <= 40; ++k) bowl.series.points.emplace_back(kStride * k, -1 + kStride * k * kStride * k);
            Curve lip{kCraterProfile, {"crest of the lip (Glasstone & Dolan)", Style::marks, 8, {{1.25, 0.25}}}};
            return Outcome{{}, {bowl, lip}};
          }};
}

}  // namespace

Result<std::vector<Experiment>> crater_shape(const Places&) {
  std::vector<Experiment> experiments = {paraboloid()};
  int color = 1;
  for (const ScaledCrater& soil : kScaledCraters)
    if (std::string_view(soil.material) != "concrete") experiments.push_back(shape(soil, color++));
  return experiments;
}

}  // namespace divot::validation
