#include "validation/families.h"
#include "validation/figures.h"

namespace divot::validation {

std::span<const Family> families() {
  static constexpr Family kFamilies[] = {
      {"paper", "the paper's own numbers, and its scene", "", &paper},
      {"crater_size", "radius and depth against charge, by soil", kCraterSize, &crater_size},
      {"crater_shape", "depth, lip, volume and profile of a crater", kCraterProfile, &crater_shape},
      {"crater_burst", "craters by height of burst and by depth of burial", "", &crater_burst},
      {"crater_shots", "single measured craters", "", &crater_shots},
      {"plate", "a plate pressed into soil", kPlate, &plate},
      {"sphere", "a sphere at rest, by soil, mass and spacing", "", &sphere},
      {"wheel", "a rigid wheel, towed and driven", kDrawbar, &wheel},
      {"passes", "the same wheel over the same ground again", "", &passes},
      {"drop", "a dropped sphere, by height and density", kDrop, &drop},
      {"repose", "slopes of loose soil at rest", "", &repose},
      {"permanence", "ruts and craters stay", "", &permanence},
      {"resolution", "what halving the spacing or the step changes", "", &resolution},
      {"soil_balance", "where the soil of every scene went", "", &soil_balance},
  };
  return kFamilies;
}

}  // namespace divot::validation
