#pragma once

#include <cstddef>

namespace divot::viewer {

/// How many pixels a renderer can draw at the rate of the display: watches what pictures take, and tells a share that
/// it keeps up with.
class PixelShare {
 public:
  /// `wanted`: s that a picture may take.
  explicit PixelShare(double wanted) : wanted_(wanted) {}

  /// A picture took `seconds`, waiting not counted.
  void see(double seconds);

  /// Of the pixels each way: 1 at first, never below 0.5.
  double share() const;

 private:
  void change(std::size_t level);

  double wanted_;
  std::size_t level_ = 0;  // of the shares there are
  double mean_ = 0;        // s, of the newest pictures
  double settled_ = 0;     // s of pictures since the share changed
};

}  // namespace divot::viewer
