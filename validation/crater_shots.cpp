// Single measured craters of chemical charges, and published predictions, from validation/data/craters.csv.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "validation/craters.h"
#include "validation/data.h"
#include "validation/families.h"

namespace divot::validation {
namespace {

// What craters of equal charges on equal ground differ by: 10 to 30 %.
constexpr double kScatter = 0.30;

std::string without_spaces(std::string name) {
  std::string out;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter))
      out += static_cast<char>(std::tolower(letter));
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out;
}

Experiment shot(const MeasuredCrater& crater) {
  const std::string name = "crater_shots/" + without_spaces(crater.shot);
  const std::string source = fmt::format("{}: {}", crater.shot, crater.source);
  const std::string how = fmt::format("{:.4g} kg, {:.3g} m {} {}", crater.charge, std::abs(crater.height),
                                      crater.height < 0 ? "below" : "above", crater.medium);
  return {{{name + "/diameter", source, "crater diameter, " + how, "m", crater.diameter, kScatter},
           {name + "/depth", source, "crater depth, " + how, "m", crater.depth, kScatter}},
          [crater]() -> Result<Outcome> {
            const auto world = explode(bomb_scene(crater.material, crater.charge, crater.height, crater.diameter / 2));
            if (!world) return tl::unexpected(world.error());
            const Crater made = world->craters().front();
            return Outcome{{made.width, made.depth}};
          }};
}

}  // namespace

Result<std::vector<Experiment>> crater_shots(const Places& places) {
  const auto craters = measured_craters(places.data);
  if (!craters) return tl::unexpected(craters.error());
  std::vector<Experiment> experiments;
  for (const MeasuredCrater& crater : *craters)
    if (crater.kind != "nuclear" && !crater.material.empty() && !std::isnan(crater.height))
      experiments.push_back(shot(crater));
  return experiments;
}

}  // namespace divot::validation
