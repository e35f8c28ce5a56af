#pragma once

#include <cstddef>

namespace divot::viewer {

/// How many pixels a renderer can draw at the rate of the display: watches what pictures take, and tells a share that
/// it keeps up with. Goes back where fewer pixels gain nothing, as where triangles are what takes long.
class PixelShare {
 public:
  /// `wanted`: s that a picture may take.
  explicit PixelShare(double wanted);

  /// A picture took `seconds`, waiting not counted.
  void see(double seconds);

  /// Of the pixels each way: 1 at first, never below 0.5.
  double share() const;

 private:
  void change(std::size_t level);

  double wanted_;
  std::size_t level_ = 0;  // of the shares there are
  double mean_ = 0;        // s, of the newest pictures, the longest cut short
  double whole_ = 0;       // s, the same of whole pictures
  double settled_ = 0;     // s of pictures since the share changed
  double before_ = 0;      // s, whole_ when pixels were last taken away; 0: what that gained is known
  double slow_ = 0;        // s of pictures that have been too slow without a break
  double hold_;            // s from one share to one with fewer pixels
};

}  // namespace divot::viewer
