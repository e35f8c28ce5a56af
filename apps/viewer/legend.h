#pragma once

#include <osg/Camera>
#include <osgText/Text>
#include <vector>

#include "viewer/color_scale.h"
#include "viewer/overlay.h"

namespace divot::viewer {

/// What the ground's colours tell, in the upper right corner of a picture.
class Legend {
 public:
  /// `width`, `height`: of the picture, pixels.
  Legend(int width, int height);

  /// Shows `scale`; nothing where its colours are natural. `offset` is added to the numbers.
  void show(const ColorScale& scale, double offset);

  osg::Camera& root() { return *overlay_; }

 private:
  // A line of text at x, y; labels are reused from picture to picture.
  void write(float x, float y, const std::string& content);

  osg::ref_ptr<osg::Camera> overlay_;
  Plates plates_;
  std::vector<osg::ref_ptr<osgText::Text>> labels_;
  std::size_t used_labels_ = 0;
  float width_, height_;
  float size_;  // of the letters, pixels
};

}  // namespace divot::viewer
