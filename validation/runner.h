#pragma once

#include <functional>
#include <string>
#include <vector>

#include "validation/experiment.h"

namespace divot::validation {

/// A case and what the simulation gave for it.
struct Finding {
  Case what;
  double simulated = 0;      ///< not a number where the run failed
  std::string problem = {};  ///< why it failed; else empty
};

/// Experiments of one family that are wanted.
struct Chosen {
  const Family* family = nullptr;
  std::vector<Experiment> experiments;
};

/// Those that `names` ask for: families, cases or what cases' names begin with up to a slash; all, where there are
/// none. Experiments without cases only feed figures and come with a whole family. Fails on a name that nothing has.
Result<std::vector<Chosen>> choose(const std::vector<std::string>& names, const Places& places);

/// What all of them gave.
struct Findings {
  std::vector<std::vector<Finding>> families;  ///< [chosen]
  std::vector<Curve> curves;                   ///< in the order of the experiments
};

/// Runs experiments side by side on `threads` threads (0: one for each core). Results do not depend on how many.
/// `done` is told the share that is finished, [0, 1], never from two threads at once.
Findings run(const std::vector<Chosen>& chosen, int threads, const std::function<void(double)>& done);

/// Cases that do not hold.
std::size_t failures(const Findings& findings);

}  // namespace divot::validation
