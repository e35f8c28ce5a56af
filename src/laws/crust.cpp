#include "laws/crust.h"

#include "laws/blast.h"

namespace divot::laws {

double broken_radius(const Medium& crust, const Medium& below, double yield, double height_of_burst) {
  const double alone = scaled_radius(yield, crust.blast_strength, height_of_burst);
  if (alone <= 0) return 0;
  const Source source = scaled_source(yield, crust.blast_strength, height_of_burst);
  const double excess = scaled_pressure(source, source.height, 1) - crust.blast_strength;
  const double deep = excess * pulse(yield) / (2 * crust.blast_drag);
  if (deep <= crust.thickness) return 0;
  const double without = scaled_radius(yield, below.blast_strength, height_of_burst);
  return without + (alone - without) * crust.thickness / deep;
}

}  // namespace divot::laws
