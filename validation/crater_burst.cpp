// How craters change with the height of a burst, and with the depth at which a charge is buried.
#include <fmt/format.h>

#include <cmath>

#include "validation/craters.h"
#include "validation/families.h"
#include "validation/simulate.h"

namespace divot::validation {
namespace {

constexpr const ScaledCrater& kSoil = kScaledCraters[1];

// Crater of a ton of TNT at a scaled height, m/kg^(1/3), above 0 in the air.
Result<Crater> at_height(double scaled) {
  const auto world = explode(bomb_scene(kSoil.material, kTon, 10 * scaled, 15 * kSoil.radius, 12));
  if (!world) return tl::unexpected(world.error());
  return world->craters().front();
}

Result<std::vector<Crater>> at_heights(const std::vector<double>& heights) {
  std::vector<Crater> craters;
  for (const double height : heights) {
    const auto crater = at_height(height);
    if (!crater) return tl::unexpected(crater.error());
    craters.push_back(*crater);
  }
  return craters;
}

// The largest ratio of a value to the one before it: below 1 where it falls all the way.
double largest_step(const std::vector<Crater>& craters, double (*value)(const Crater&)) {
  double largest = 0;
  for (std::size_t k = 1; k < craters.size(); ++k)
    largest = std::max(largest, value(craters[k]) / value(craters[k - 1]));
  return largest;
}

double width(const Crater& crater) { return crater.width; }
double depth(const Crater& crater) { return crater.depth; }
double aspect(const Crater& crater) { return crater.depth / crater.width; }

Experiment in_the_air() {
  const char* falls = "craters fall off with the height of burst, and grow shallower";
  const char* ends = "no crater from above 0.6 m/kg^(1/3)";
  const auto ratio = [&](const char* name, const char* quantity) {
    return Case{std::string("crater_burst/") + name, falls, quantity, "1", 1, 0, Bound::at_most};
  };
  return {
      {ratio("width_falls", "largest ratio of widths, 0 to 0.4 m/kg^(1/3) by 0.1"),
       ratio("depth_falls", "largest ratio of depths, the same heights"),
       ratio("flattens", "largest ratio of depth over width, the same heights"),
       {"crater_burst/ends", ends, "depth at 0.65 m/kg^(1/3) over that at the surface", "1", 0.02, 0, Bound::at_most}},
      []() -> Result<Outcome> {
        auto craters = at_heights({0, 0.1, 0.2, 0.3, 0.4});
        const auto high = at_height(0.65);
        if (!craters) return tl::unexpected(craters.error());
        if (!high) return tl::unexpected(high.error());
        return Outcome{{largest_step(*craters, width), largest_step(*craters, depth), largest_step(*craters, aspect),
                        high->depth / craters->front().depth}};
      }};
}

// Depth of burial of the widest of craters, from the parabola through it and its neighbours.
double optimum(const std::vector<double>& buried, const std::vector<Crater>& craters, double (*value)(const Crater&)) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < craters.size(); ++k)
    if (value(craters[k]) > value(craters[best])) best = k;
  if (best == 0 || best + 1 == craters.size()) return buried[best];
  const double before = value(craters[best - 1]), at = value(craters[best]), after = value(craters[best + 1]);
  return buried[best] + 0.5 * (buried[1] - buried[0]) * (before - after) / (before - 2 * at + after);
}

Experiment buried() {
  const char* series = "Stagecoach I-III, Scooter (1960): largest at 0.4 to 0.5 m/kg^(1/3)";
  return {
      {between({"crater_burst/optimum_width", series, "depth of burial of the widest crater", "m/kg^(1/3)"}, 0.3, 0.7),
       between({"crater_burst/optimum_depth", series, "depth of burial of the deepest crater", "m/kg^(1/3)"}, 0.2, 0.6),
       {"crater_burst/grows", series, "width at 0.4 m/kg^(1/3) over that at the surface", "1", 1.2, 0, Bound::at_least},
       {"crater_burst/falls", "Stagecoach I over III (1960)", "depth at 0.93 over that at 0.4 m/kg^(1/3)", "1", 0.6, 0,
        Bound::at_most}},
      []() -> Result<Outcome> {
        const std::vector<double> depths = {0, 0.2, 0.4, 0.6, 0.8, 1.0};
        std::vector<double> heights;
        for (const double d : depths) heights.push_back(-d);
        const auto craters = at_heights(heights);
        const auto deep = at_height(-0.93);
        if (!craters) return tl::unexpected(craters.error());
        if (!deep) return tl::unexpected(deep.error());
        return Outcome{{optimum(depths, *craters, width), optimum(depths, *craters, depth),
                        (*craters)[2].width / (*craters)[0].width, deep->depth / (*craters)[2].depth}};
      }};
}

}  // namespace

Result<std::vector<Experiment>> crater_burst(const Places&) { return std::vector{in_the_air(), buried()}; }

}  // namespace divot::validation
