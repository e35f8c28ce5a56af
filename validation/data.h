#pragma once

#include <string>
#include <vector>

#include "divot/errors.h"
#include "divot/material.h"

// Measured data: validation/data/README.md says what the columns are.
namespace divot::validation {

/// A row of craters.csv. Lengths in m; not a number where the source has none.
struct MeasuredCrater {
  std::string shot, kind, medium, material, source;
  double charge = 0;  ///< kg of TNT
  double height = 0;  ///< of burst, below 0: buried
  double diameter = 0, depth = 0;
};

/// A row of soils.csv in SI.
struct MeasuredSoil {
  std::string terrain, source;
  double moisture = 0;                               ///< percent; not a number where the source has none
  double n = 0, kc = 0, kphi = 0;                    ///< 1, N/m^(n+1), N/m^(n+2)
  double cohesion = 0;                               ///< Pa
  double friction_angle_deg = 0, shear_modulus = 0;  ///< degrees, m
};

/// Rows of a CSV file as cells of text, the first holding the columns' names. Cells may stand between double quotes.
std::vector<std::vector<std::string>> parse_csv(const std::string& text);

Result<std::vector<MeasuredCrater>> measured_craters(const std::string& folder);
Result<std::vector<MeasuredSoil>> measured_soils(const std::string& folder);

/// The row of that terrain and moisture (any, where it is 0). Fails where there is none.
Result<MeasuredSoil> find_soil(const std::vector<MeasuredSoil>& soils, const std::string& terrain, double moisture = 0);

/// Dry sand with the measured Bekker-Wong and Mohr-Coulomb parameters, called `measured`.
Material material_of(const MeasuredSoil& soil);

}  // namespace divot::validation
