#pragma once

#include <memory>
#include <osg/Group>
#include <osg/MatrixTransform>
#include <span>
#include <vector>

#include "divot/views.h"

namespace divot::viewer {

/// The bodies in their shape, size, place and orientation.
class BodyNode {
 public:
  /// `sphere`: a unit sphere that all balls share.
  explicit BodyNode(osg::ref_ptr<osg::Node> sphere);

  /// `origin`: the surface's, m. [O(bodies)]
  void update(const Vec3d& origin, std::span<const BodyView> bodies);

  /// Draws a body no longer, because something else stands for it.
  void hide(std::uint32_t body);

  osg::Group& root() { return *root_; }
  /// Those of root() that are no balls.
  osg::Group& solids() { return *solids_; }

 private:
  struct Place {
    std::shared_ptr<const Shape> shape;
    osg::ref_ptr<osg::MatrixTransform> node;
  };
  void make_place(Place& place, const std::shared_ptr<const Shape>& shape);

  osg::ref_ptr<osg::Node> sphere_;
  osg::ref_ptr<osg::Group> root_, balls_, solids_;
  std::vector<Place> places_;  // [body]
};

/// m; 0: no ball. Bodies without a shape are balls. A ball's own, however far its centre of mass lies from its middle.
double ball_radius(const BodyView& body);

}  // namespace divot::viewer
