#pragma once

#include <string>
#include <vector>

#include "bench/bench.h"

namespace divot::bench {

/// A scene to measure.
struct Case {
  std::string name;
  Scene scene;
};

/// What is left of a case: its numbers and its ground at the end.
struct Outcome {
  Measurement measurement;
  std::vector<Vec3> surface;  ///< [vertex] m
};

/// Runs each case `repeats` times on one thread, in turns, so that a machine that slows down slows all of them, and
/// takes medians. Fails where a scene cannot be used or where repeats do not end in the same bits.
Result<std::vector<Outcome>> repeat(const std::vector<Case>& cases, int repeats);

}  // namespace divot::bench
