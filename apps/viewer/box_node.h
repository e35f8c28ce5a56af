#pragma once

#include <osg/Geometry>
#include <span>
#include <utility>

#include "divot/vec.h"

namespace divot::viewer {

/// Boxes as wire frames: their corners with the least and the greatest coordinates, m, relative to the surface's
/// origin.
class BoxNode {
 public:
  BoxNode();

  /// [O(boxes)]
  void update(std::span<const std::pair<Vec3, Vec3>> boxes);

  osg::Node& root() { return *lines_; }

 private:
  osg::ref_ptr<osg::Geometry> lines_;
  osg::ref_ptr<osg::Vec3Array> corners_;
  osg::ref_ptr<osg::DrawElementsUInt> edges_;
};

}  // namespace divot::viewer
