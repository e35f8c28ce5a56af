#pragma once

#include <osg/Camera>
#include <osgText/Text>
#include <string>

namespace divot::viewer {

/// One line of text in the lower left corner.
class Caption {
 public:
  /// `width`, `height`: of the picture, pixels. `dark`: dark letters for a light background.
  Caption(int width, int height, bool dark);

  void set_text(const std::string& text);

  osg::Camera& root() { return *overlay_; }

 private:
  osg::ref_ptr<osg::Camera> overlay_;
  osg::ref_ptr<osgText::Text> text_;
};

}  // namespace divot::viewer
