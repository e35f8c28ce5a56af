#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "divot/errors.h"
#include "divot/world.h"

namespace divot {

/// What a run's results tell besides its world.
struct RunTotals {
  double wall_s = 0;                   ///< s, how long the run took
  std::uint64_t substeps_limited = 0;  ///< steps in which StepReport::substeps_limited was set
  std::uint64_t not_finite = 0;        ///< steps in which StepReport::not_finite was set
  bool interrupted = false;            ///< stopped before its time
};

/// Writes the files of a run into one folder and nowhere else. Each appears under its name when it is complete, or not
/// at all.
class Recorder {
 public:
  /// Makes `folder`, with those above it, and starts `bodies.csv` in it. Fails with the system's reason.
  static Result<Recorder> create(const std::string& folder);

  Recorder(Recorder&&) noexcept;
  Recorder& operator=(Recorder&&) noexcept;
  /// Without finish() no `bodies.csv` remains.
  ~Recorder();

  /// One row of `bodies.csv` for each body as it is now. Failures are reported by finish().
  void add_bodies(const World& world);

  /// The ground as it is now in each of Scene::output's formats: `frame_000000.ply` and on. Fails with all that could
  /// not be written. [O(vertices)]
  Result<void> write_frame(const World& world);

  /// What every run leaves: `summary.json`, `bodies.csv`, `terrain_final.ply`, `terrain_final.tif` for terrain made
  /// from a grid or a DEM, and `terrain_final.csv` where `csv` is asked for. Every file is tried; fails with all that
  /// could not be written. The recorder is done then. [O(vertices)]
  Result<void> finish(const World& world, const RunTotals& totals);

 private:
  struct Impl;
  explicit Recorder(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace divot
