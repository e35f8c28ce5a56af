#pragma once

#include <string>
#include <vector>

#include "divot/errors.h"
#include "divot/scene.h"

// A single wheel on a rail, as terramechanics laboratories have it: a carriage moves it along at a given speed, it is
// free to sink under a given load, and it rolls freely or is driven at a given slip.
namespace divot::validation {

struct Rig {
  double radius = 0.4, width = 0.3;  ///< m
  double load = 3000;                ///< N
  double speed = 0.3;                ///< m/s
  bool driven = false;
  double slip = 0;        ///< of a driven wheel: 1 - speed / (spin x radius)
  int passes = 1;         ///< to and fro over the same ground
  double spacing = 0.03;  ///< m
};

/// Means over the middle of one pass.
struct Pass {
  double sinkage = 0;  ///< m, of the wheel's lowest point
  double rut = 0;      ///< m, mean depth of the ground behind it, across two thirds of its width
  double pull = 0;     ///< N, by which it pulls the carriage on; negative: the carriage pulls it
};

/// One for each pass. `scene` has the ground's material, called `ground`.
Result<std::vector<Pass>> run_rig(const Material& ground, const Rig& rig);

}  // namespace divot::validation
