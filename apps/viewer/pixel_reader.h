#pragma once

#include <osg/Camera>

#include "viewer/image.h"

namespace divot::viewer {

/// Fetches each finished frame of a camera whose final draw callback it is.
class PixelReader : public osg::Camera::DrawCallback {
 public:
  void operator()(osg::RenderInfo& info) const override;

  /// The last frame; empty before there was one.
  const Image& image() const { return image_; }

 private:
  mutable Image image_;  // callbacks are const
};

}  // namespace divot::viewer
