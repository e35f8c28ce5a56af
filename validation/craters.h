#pragma once

#include "divot/world.h"
#include "validation/experiment.h"

// Bombs on flat ground and what they leave: shared by the families of craters.
namespace divot::validation {

/// What TM 5-855-1 has measured of charges on a soil, m/kg^(1/3), and the preset that stands for it.
struct ScaledCrater {
  const char* material;
  const char* medium;
  double radius, depth;
};
inline constexpr ScaledCrater kScaledCraters[] = {{"dry_sand", "dry sand", 0.297, 0.149},
                                                  {"clay_dry", "dry sandy clay", 0.389, 0.218},
                                                  {"clay_wet", "wet clay", 0.456, 0.228},
                                                  {"concrete", "concrete", 0.151, 0.079}};
inline constexpr const char* kManual = "TM 5-855-1 (1986), surface bursts";

/// One bomb in the middle of flat ground that reaches to four `radius` on each side, `per_radius` vertices a radius.
/// `height`: of burst, m, below 0: buried. `charge` in kg of TNT.
Scene bomb_scene(const std::string& material, double charge, double height, double radius, int per_radius = 8);

/// Its crater, after the ground has come to rest.
Result<World> explode(const Scene& scene);

}  // namespace divot::validation
