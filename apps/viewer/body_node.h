#pragma once

#include <osg/Group>
#include <span>

#include "divot/views.h"

namespace divot::viewer {

/// The bodies as balls of their size, place and orientation.
class BodyNode {
 public:
  /// `sphere`: a unit sphere that all bodies share.
  explicit BodyNode(osg::ref_ptr<osg::Node> sphere);

  /// `origin`: the surface's, m. [O(bodies)]
  void update(const Vec3d& origin, std::span<const BodyView> bodies);

  osg::Group& root() { return *root_; }

 private:
  osg::ref_ptr<osg::Node> sphere_;
  osg::ref_ptr<osg::Group> root_;
};

}  // namespace divot::viewer
