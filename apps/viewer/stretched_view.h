#pragma once

#include <osg/Camera>
#include <osg/Node>
#include <osg/ref_ptr>

namespace divot::viewer {

/// A scene that can be drawn with fewer pixels than the picture has, and stretched over it. What is beside it in the
/// graph, such as letters, stays sharp.
class StretchedView {
 public:
  explicit StretchedView(osg::Node& scene);

  osg::Node& root() { return *root_; }

  /// The picture's pixels, and the share of them each way that the scene is drawn with, (0, 1]. 1 is without a detour.
  void set_size(int width, int height, double share);

 private:
  void stretch(int width, int height);

  osg::ref_ptr<osg::Node> scene_;
  osg::ref_ptr<osg::Group> root_;
  int width_ = 0, height_ = 0;
  double share_ = 0;
};

}  // namespace divot::viewer
