#pragma once

#include <memory>
#include <string>
#include <vector>

#include "divot/jobs.h"
#include "divot/world.h"

namespace divot::viewer {

/// A world whose time runs with the clock on the wall, and that keeps what is done to it (World::commands).
class LiveWorld {
 public:
  /// Fails like World::create. `jobs` is kept.
  static Result<LiveWorld> create(const Scene& scene, std::shared_ptr<const Jobs> jobs);

  /// Steps as far as `real` seconds ask for at the current speed. What a few steps cannot catch up with is dropped:
  /// simulated time lags then.
  void advance(double real);

  /// One step, also while paused.
  void step();

  /// From the scene's start again; bodies and bombs that were added are gone.
  Result<void> restart();

  void toggle_pause() { paused_ = !paused_; }
  bool paused() const { return paused_; }

  /// 1, 1/4, 1/16 of real time, and 1 again.
  void next_speed();
  double speed() const { return speed_; }

  /// The last half second could not be simulated in time.
  bool lagging() const { return lag_ > 0; }

  /// Simulated seconds per second, over about the last second; 0 while paused.
  double real_time_factor() const { return factor_; }

  World& world() { return world_; }
  const World& world() const { return world_; }

 private:
  LiveWorld(World world, std::shared_ptr<const Jobs> jobs) : jobs_(std::move(jobs)), world_(std::move(world)) {}

  std::shared_ptr<const Jobs> jobs_;
  World world_;
  double speed_ = 1;
  double due_ = 0;  // s of simulated time that no step has covered yet
  double lag_ = 0;  // s of real time for which it still counts as lagging
  double factor_ = 1;
  bool paused_ = false;
};

}  // namespace divot::viewer
