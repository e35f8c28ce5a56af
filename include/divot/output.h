#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

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

/// A scene file and how it was changed.
struct SceneFile {
  std::string path;                 ///< of the file
  std::vector<Override> overrides;  ///< in order
  std::string replay;               ///< the recording that is carried out on it; empty: none
};

/// A run put aside: what it takes to go on as if it had never stopped.
struct Checkpoint {
  SceneFile scene;    ///< what the world came from
  RunTotals totals;   ///< so far
  std::string world;  ///< of World::save()
  std::string files;  ///< what a Recorder had written: its own bytes
};

/// Writes a checkpoint, with a version and a checksum, under its name when it is complete or not at all. Fails with the
/// system's reason.
Result<void> write_checkpoint(const std::string& path, const Checkpoint& checkpoint);

/// Reads one. Fails on a file that is no checkpoint, of another version, cut short or damaged, before memory is taken
/// for what it does not hold.
Result<Checkpoint> read_checkpoint(const std::string& path);

/// Writes the files of a run into one folder and nowhere else. Each appears under its name when it is complete, or not
/// at all. The ground is copied and written by a thread of the recorder's own, so that stepping does not wait for the
/// disk unless more than 512 MB wait for it. After the first file that cannot be written there are no more; those
/// before it stay whole.
class Recorder {
 public:
  /// Makes `folder`, with those above it, and starts `bodies.csv` in it. Fails with the system's reason.
  static Result<Recorder> create(const std::string& folder);

  /// Goes on in `folder` where the recorder of a run put aside was: with its rows of `bodies.csv` and the numbers of
  /// its frames. Fails likewise, and on a checkpoint that holds something else.
  static Result<Recorder> resume(const std::string& folder, const Checkpoint& checkpoint);

  Recorder(Recorder&&) noexcept;             ///< nothing is written twice
  Recorder& operator=(Recorder&&) noexcept;  ///< likewise
  /// Waits for what is being written. Without finish(), `bodies.csv` ends with the last rows added.
  ~Recorder();

  /// One row of `bodies.csv` for each body as it is now. Failures are reported by finish().
  void add_bodies(const World& world);

  /// The ground as it is now in each of Scene::output's formats: `frame_000000.ply` and on. Fails with the first file
  /// so far that could not be written: of this frame or one before. [O(vertices)]
  Result<void> write_frame(const World& world);

  /// Puts the run aside as `checkpoint.divot`, in place of the one before, once all frames so far are written. Fails
  /// with the first file so far that could not be written. [O(touched vertices + rows of bodies.csv)]
  Result<void> write_checkpoint(const World& world, const RunTotals& totals, const SceneFile& scene);

  /// What every run leaves: `summary.json`, `bodies.csv` up to the bodies as they are now, `terrain_final.ply`,
  /// `terrain_final.tif` for terrain made from a grid or a DEM, and `terrain_final` in the scene's other formats. Waits
  /// until all is written; fails with the first file that could not be. The recorder is done then. [O(vertices)]
  Result<void> finish(const World& world, const RunTotals& totals);

 private:
  struct Impl;
  explicit Recorder(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// A run as one page for a browser that needs no network: the ground and bodies in three dimensions with a scrubber,
/// crater profiles, energy and soil over time, time per stage, the scene. Keeps what moved at each time that add() is
/// called, compressed; when the page would grow beyond about 12 MB, every other time is dropped. Terrain of more than
/// 400,000 vertices is drawn on a coarser grid.
class Report {
 public:
  /// `scene_text`: shown on the page, as the file's text with what the command line changed.
  explicit Report(std::string scene_text);
  Report(Report&&) noexcept;             ///< keeps what was added
  Report& operator=(Report&&) noexcept;  ///< likewise
  ~Report();

  /// The world as it is now. The first call should come before the first step. [O(vertices)]
  void add(const World& world);

  /// Writes the page, with the world as it is now as the last time. Fails with the system's reason, or where the
  /// library was built without three.js.
  Result<void> write(const std::string& path, const World& world, const RunTotals& totals);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace divot
