#pragma once

#include <span>
#include <string>
#include <vector>

#include "divot/world.h"

namespace divot::viewer {

/// Milliseconds a picture for each stage, from the totals that a world counts, smoothed so that they can be read.
class StageMeter {
 public:
  struct Row {
    std::string name;
    double ms = 0;
  };

  /// Call once for each picture. Totals that went down belong to a new world.
  void update(std::span<const StageTime> totals);

  std::span<const Row> rows() const { return rows_; }

 private:
  std::vector<double> totals_;
  std::vector<Row> rows_;
};

}  // namespace divot::viewer
