#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "divot/world.h"

namespace divot::viewer {

/// What it took to show a world.
struct PictureCost {
  std::uint64_t bytes = 0;  ///< of vertices and indices, handed over to be sent to the graphics card
  double update_ms = 0;     ///< positions copied and normals made anew
  double draw_ms = 0;       ///< sent and drawn, until the driver says that it is done
};

/// Shows a world without a display and measures what that takes.
class UploadMeter {
 public:
  /// `width`, `height`: pixels, >= 16. Frames the world as it is now. Fails when the machine has no driver that can
  /// draw without a display.
  static Result<UploadMeter> create(World& world, int width, int height);

  UploadMeter(UploadMeter&&) noexcept;
  UploadMeter& operator=(UploadMeter&&) noexcept;
  ~UploadMeter();

  /// Shows the world as it is now and sends what `dirty` names (ascending, disjoint). Takes the world's own dirty
  /// ranges with it.
  PictureCost show(World& world, std::vector<DirtyRange> dirty);

 private:
  struct Impl;
  explicit UploadMeter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace divot::viewer
