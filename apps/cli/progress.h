#pragma once

#include <chrono>
#include <string>

namespace divot::cli {

/// How many seconds are simulated in one, to about three digits: 0.25, 12.5, 1200.
std::string factor_text(double factor);

/// How far a run is, as a line of at most `width` columns: bar, simulated time, real-time factor, time left. What does
/// not fit is left out, the bar first. `simulated`, `total` and `elapsed` in s, `total` > 0.
std::string progress_line(double simulated, double total, double elapsed, int width);

/// A line on the terminal that follows a run, and is gone when the run is. Does nothing where stderr is no terminal.
class Progress {
 public:
  /// `total`: simulated time of the run, s. `wanted` false: does nothing anywhere.
  Progress(double total, bool wanted);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Draws anew, at most ten times a second.
  void update(double simulated);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  double total_;
  bool shown_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

}  // namespace divot::cli
