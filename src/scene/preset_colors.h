#pragma once

#include <string_view>
#include <utility>

namespace divot::scene {

/// What a preset looks like on the untouched surface, `#rrggbb`; empty: up to what draws it. Chosen by eye from
/// photographs, not measured.
inline const char* preset_color(std::string_view name) {
  constexpr std::pair<std::string_view, const char*> kColors[] = {
      {"dry_sand", "#c8ad7f"},       {"lete_sand", "#bfa476"}, {"sandy_loam", "#8f7350"}, {"clay_dry", "#a5805c"},
      {"clay_wet", "#7d5a42"},       {"mud", "#65503b"},       {"snow", "#eef2f5"},       {"wheat_field", "#b99a55"},
      {"gravel", "#8d8a84"},         {"asphalt", "#55575b"},   {"concrete", "#a9a8a3"},   {"rock", "#7f7b76"},
      {"lunar_regolith", "#77756f"},
  };
  for (const auto& [preset, color] : kColors) {
    if (preset == name) return color;
  }
  return "";
}

}  // namespace divot::scene
