#include "divot/blast.h"
#include "laws/blast.h"

namespace divot {

BlastSource blast_source(double yield) {
  const double shock = laws::shock_pressure(yield);
  return {.shock_db = laws::to_decibel(shock),
          .shock = shock,
          .blast_wave = laws::blast_wave_pressure(shock),
          .total = laws::total_pressure(yield),
          .crater_width = laws::crater_width(yield)};
}

double blast_force(double yield, double distance, double particles) {
  const double pressure = laws::pressure_at(laws::total_pressure(yield), distance, laws::charge_radius(yield));
  return laws::particle_force(pressure, laws::crater_width(yield), particles);
}

}  // namespace divot
