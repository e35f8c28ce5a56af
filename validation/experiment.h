#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/plot.h"
#include "divot/errors.h"
#include "validation/case.h"

namespace divot::validation {

/// Folders that experiments read.
struct Places {
  std::string scenes;  ///< scene files
  std::string data;    ///< measured data
};

/// What an experiment adds to a figure.
struct Curve {
  std::string figure;  ///< its name, see figures.h
  cli::CurveChart::Series series;
};

/// What came out of an experiment.
struct Outcome {
  std::vector<double> simulated;  ///< one for each case, in its unit; not a number where nothing could be measured
  std::vector<Curve> curves = {};
};

/// Runs that are made together, and the cases they answer. Experiments know nothing of each other and run side by
/// side, each on one thread.
struct Experiment {
  std::vector<Case> cases;
  std::function<Result<Outcome>()> run;
};

/// Experiments of one kind.
struct Family {
  const char* name;  ///< the first part of its cases' names
  const char* what;
  const char* figure;  ///< the figure that goes with it; empty: none
  Result<std::vector<Experiment>> (*make)(const Places& places);
};

}  // namespace divot::validation
