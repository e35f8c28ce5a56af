#pragma once

#include <osg/Camera>
#include <osg/Geometry>
#include <osgText/Text>
#include <string>

namespace divot::viewer {

/// A camera that draws pixels over the picture: x rightward, y upward from the lower left corner.
osg::ref_ptr<osg::Camera> make_overlay(int width, int height);

/// Text of `size` pixels with its baseline at its position, in DejaVu Sans where it is installed.
osg::ref_ptr<osgText::Text> make_text(float size, const osg::Vec4& color);

/// Sets the text where it differs from what is shown: laying out letters anew takes time.
void set_text(osgText::Text& text, const std::string& content);

/// Rectangles of one colour each.
class Plates {
 public:
  Plates();

  void clear();
  /// From the lower left corner, in pixels.
  void add(float x, float y, float width, float height, const osg::Vec4& color);
  /// Shows what was added since clear().
  void finish();

  osg::Geometry& root() { return *geometry_; }

 private:
  osg::ref_ptr<osg::Geometry> geometry_;
  osg::ref_ptr<osg::Vec3Array> corners_;
  osg::ref_ptr<osg::Vec4Array> colors_;
  osg::ref_ptr<osg::DrawArrays> drawn_;
};

}  // namespace divot::viewer
