#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/bench.h"

namespace divot::bench {

double median(std::vector<double> values);

/// How a world is stepped for a measurement.
struct Stepping {
  int threads = 1;
  int warm_up = 3;                                                          ///< steps that are not measured
  int steps = 10;                                                           ///< that are
  std::function<Result<void>(World&, int step)> before = {};                ///< what happens before a step
  std::function<Result<void>(const World&, const StepReport&)> after = {};  ///< what each measured step must be
};

/// Steps a world of the scene and takes medians over its steps: wall time, and CPU time of all threads. Particles are
/// those of the last step, stages sums over the measured steps.
Result<Measurement> measure_steps(const std::string& name, const Scene& scene, const Stepping& how);

/// The same for a world that exists.
Result<Measurement> measure_steps(const std::string& name, World& world, const Stepping& how);

/// A chart of milliseconds a step over something, both logarithmic, without curves.
cli::CurveChart curves(const char* name, const char* title, const char* x_label);
/// Adds a point to the curve of that name, which is made when it is new.
void add_point(cli::CurveChart& chart, const std::string& name, double x, double y);

/// A table of measurements: a line for each, with the stages in microseconds a step.
std::string table(const std::vector<Measurement>& results, const char* count_name);

}  // namespace divot::bench
