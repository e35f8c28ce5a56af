#pragma once

namespace divot {

/// What a charge is before it meets the ground: eq. 8-12 of the paper.
struct BlastSource {
  double shock_db = 0;      ///< dB over 20 uPa, eq. 9
  double shock = 0;         ///< Pa, eq. 8 and 9
  double blast_wave = 0;    ///< Pa, eq. 11
  double total = 0;         ///< Pa, eq. 12
  double crater_width = 0;  ///< m, eq. 10
};

/// The source of a charge of `yield` metric tons of TNT, > 0.
BlastSource blast_source(double yield);

/// Eq. 14: force on one of `particles` that share the crater, `distance` m from a charge of `yield` t, N. Inside the
/// charge as at its surface.
double blast_force(double yield, double distance, double particles);

}  // namespace divot
