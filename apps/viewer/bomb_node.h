#pragma once

#include <osg/Group>
#include <span>

#include "divot/views.h"

namespace divot::viewer {

/// Charges that have not gone off yet, as balls: at least as large as the TNT would be, and large enough to be seen.
class BombNode {
 public:
  /// `sphere`: a unit sphere that all bombs share.
  explicit BombNode(osg::ref_ptr<osg::Node> sphere);

  /// `origin`: the surface's, m. `extent`: m, how wide the picture's region is; the largest bomb is at least 1.5 % of
  /// it wide. [O(bombs)]
  void update(const Vec3d& origin, std::span<const BombView> bombs, double extent);

  osg::Group& root() { return *root_; }

 private:
  osg::ref_ptr<osg::Node> sphere_;
  osg::ref_ptr<osg::Group> root_;
};

}  // namespace divot::viewer
