#include "laws/crust.h"

#include "laws/crater.h"

namespace divot::laws {

double broken_radius(const Medium& crust, const Medium& below, double yield, double height, double gravity) {
  const CraterSize alone = scaled_crater(yield, height, crust, gravity);
  const CraterSize without = scaled_crater(yield, height, below, gravity);
  // A charge below it lifts the crust with the ground.
  if (-height > crust.thickness) return without.radius;
  if (alone.depth <= crust.thickness) return 0;
  return without.radius + (alone.radius - without.radius) * crust.thickness / alone.depth;
}

}  // namespace divot::laws
