#pragma once

namespace divot::laws {

// The source: eq. 8-12 of the paper. Yields N in metric tons of TNT, pressures in Pa.

inline constexpr double kAtmosphere = 101325;        ///< Pa
inline constexpr double kReferenceShock_dB = 210.6;  ///< shock pressure of one ton of TNT
inline constexpr double kReferenceWidth = 7.13232;   ///< crater width of one ton of TNT, m
inline constexpr double kTntDensity = 1654;          ///< kg/m^3
inline constexpr double kReferencePulse = 2.5e-3;    ///< s, duration of the pressure of one ton: 0.25 ms/kg^(1/3)

/// Eq. 8 and its inverse.
double to_decibel(double pressure);
double from_decibel(double decibel);

/// Eq. 9: shock pressure. `yield` > 0.
double shock_pressure(double yield);
/// Eq. 10: crater width, m.
double crater_width(double yield);
/// Eq. 11: pressure of the blast wave that goes with a shock.
double blast_wave_pressure(double shock);
/// Eq. 12: both, at the point of the explosion.
double total_pressure(double yield);
/// Eq. 13: what is left of `total` at distance x, m. Below the charge's radius the pressure is that at its surface.
double pressure_at(double total, double x, double charge_radius);
/// Duration of the pressure pulse, s: eq. 14 has none. It scales with N^(1/3).
double pulse(double yield);
/// Radius of a ball of TNT of that yield, m.
double charge_radius(double yield);
/// Eq. 14: force on one of `count` particles that share a crater `width` wide, N.
double particle_force(double pressure, double width, double count);

// Cube-root scaled model: eq. 13 with Hopkinson's scaled distance from a virtual source above ground zero, because eq.
// 13 is singular at the burst itself. Soil fails where the pressure into the ground exceeds its blast strength.

/// Height of the virtual source, in crater radii. Lower makes the crater a cone, higher a disc; here it is close to the
/// paraboloid that craters are measured as [Glasstone & Dolan 1977].
inline constexpr double kSourceHeight = 1.5;
/// Radius within which weightless soil of that strength, Pa, fails under a burst at the ground, m.
double surface_radius(double yield, double strength);
/// How deep it flows against its drag, Pa s/m, at ground zero while the pulse lasts, m.
double surface_depth(double yield, double strength, double drag);

/// The burst as the paper's model sees it: from a virtual source above ground zero.
struct Source {
  double yield = 0;
  double height = 0;  ///< of the virtual source above ground zero, m

  /// Distance from the virtual source to a point of the ground `radius` from ground zero and `above` it, m.
  double distance(double radius, double above) const;
};

/// The paper's model: virtual source no lower than a share of the crater's width.
Source paper_source(double yield, double height_of_burst);
/// Acceleration by eq. 14 into the ground, m/s^2, of the soil that the crater's particles stand for.
double paper_push(const Source& source, double distance, double cosine);

}  // namespace divot::laws
