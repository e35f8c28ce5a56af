#pragma once

#include <memory>

#include "divot/errors.h"

namespace divot::viewer {

/// An OpenGL context with its own picture in memory: no display, no X server and no environment variable needed.
class OffscreenContext {
 public:
  /// `width`, `height`: pixels, >= 1. `samples`: of a pixel, which smooth edges, where the driver can do it; 0: none.
  /// Fails when the machine has no EGL driver for it, and says which package has one.
  static Result<OffscreenContext> create(int width, int height, int samples);

  OffscreenContext(OffscreenContext&&) noexcept;
  OffscreenContext& operator=(OffscreenContext&&) noexcept;
  ~OffscreenContext();

  /// Makes it the calling thread's context. OpenGL must only be used after this.
  Result<void> make_current() const;

 private:
  struct Handles;
  explicit OffscreenContext(std::unique_ptr<Handles> handles);
  std::unique_ptr<Handles> handles_;
};

}  // namespace divot::viewer
