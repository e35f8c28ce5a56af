#include "laws/blast.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace divot::laws {
namespace {

using std::numbers::pi;

// The paper's model: lowest virtual source, in crater widths. Sets how far out the sheet's edge (5 % of the depth)
// lies.
constexpr double kPaperHeight = 0.265;
// Mass of the paper's crater: 98 particles of 1 kg. Eq. 13 divides a pressure by a volume, so eq. 14 does not scale by
// itself.
constexpr double kPaperMass = 98;

double fall_off(double x) { return 4.0 / 3 * pi * x * x * x; }

}  // namespace

double to_decibel(double pressure) { return 20 * std::log10(pressure / 2e-5); }
double from_decibel(double decibel) { return 2e-5 * std::pow(10, decibel / 20); }
double shock_pressure(double yield) { return from_decibel(kReferenceShock_dB + 6.67 * std::log10(yield)); }
double crater_width(double yield) { return kReferenceWidth * std::cbrt(yield); }
double blast_wave_pressure(double shock) { return 2.5 * shock * shock / (7 * kAtmosphere + shock); }
double total_pressure(double yield) {
  const double shock = shock_pressure(yield);
  return shock + blast_wave_pressure(shock);
}
double pulse(double yield) { return kReferencePulse * std::cbrt(yield); }
double charge_radius(double yield) { return std::cbrt(1000 * yield / (4.0 / 3 * pi * kTntDensity)); }
double pressure_at(double total, double x, double radius) { return total / fall_off(std::max(x, radius)); }
double particle_force(double pressure, double width, double count) {
  return pressure * pi * width * width / (4 * count);
}

double Source::distance(double radius, double above) const { return std::hypot(radius, height - above); }

double surface_radius(double yield, double strength) {
  // At the edge P = strength: P_1 N h / (4/3 pi (R^2 + h^2)^2) = strength with h = 1.5 R.
  const double slant = 1 + kSourceHeight * kSourceHeight;
  return std::cbrt(total_pressure(1) * yield / (4.0 / 3 * pi * strength) * kSourceHeight / (slant * slant));
}

double surface_depth(double yield, double strength, double drag) {
  // (P - strength) T / (2 drag) below the source, where P / strength = ((1 + 1.5^2) / 1.5^2)^2.
  const double slant = 1 / (kSourceHeight * kSourceHeight) + 1;
  return (slant * slant - 1) * strength * pulse(yield) / (2 * drag);
}

Source paper_source(double yield, double height_of_burst) {
  return {yield, std::max(height_of_burst, kPaperHeight * crater_width(yield))};
}

double paper_push(const Source& source, double distance, double cosine) {
  const double pressure = pressure_at(total_pressure(source.yield), distance, charge_radius(source.yield));
  return particle_force(pressure, crater_width(source.yield), 1) / kPaperMass * cosine;
}

}  // namespace divot::laws
