// The same wheel over the same ground again: what was compacted by the first pass gives way less to the second.
#include <fmt/format.h>

#include "validation/families.h"
#include "validation/simulate.h"
#include "validation/wheel_rig.h"

namespace divot::validation {
namespace {

Experiment again(const char* name, double load) {
  const char* source = "multi-pass: ruts deepen ever less (Bekker 1969, Wong 2008)";
  return {{{fmt::format("passes/{}/second", name), source,
            fmt::format("what the second pass adds to the rut over the first's, {:g} kN", load / 1000), "1", 1, 0,
            Bound::at_most},
           {fmt::format("passes/{}/third", name), source, "what the third pass adds over the second's", "1", 1, 0,
            Bound::at_most},
           {fmt::format("passes/{}/resistance", name), source, "rolling resistance in the second pass over the first's",
            "1", 1, 0, Bound::at_most}},
          [=]() -> Result<Outcome> {
            const auto passes = run_rig(*find_preset(name), {.load = load, .speed = 1, .passes = 3, .spacing = 0.04});
            if (!passes) return tl::unexpected(passes.error());
            const auto& p = *passes;
            return Outcome{{(p[1].rut - p[0].rut) / p[0].rut, (p[2].rut - p[1].rut) / (p[1].rut - p[0].rut),
                            p[1].pull / p[0].pull}};
          }};
}

}  // namespace

Result<std::vector<Experiment>> passes(const Places&) {
  std::vector<Experiment> experiments;
  struct Soil {
    const char* name;
    double load;
  };
  constexpr Soil kSoft[] = {{"dry_sand", 3000},    {"lete_sand", 6000}, {"sandy_loam", 3000},
                            {"clay_wet", 3000},    {"mud", 1000},       {"snow", 1000},
                            {"wheat_field", 3000}, {"gravel", 6000},    {"lunar_regolith", 3000}};
  for (const Soil& soil : kSoft) experiments.push_back(again(soil.name, soil.load));
  return experiments;
}

}  // namespace divot::validation
