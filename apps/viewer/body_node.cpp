#include "viewer/body_node.h"

#include <osg/MatrixTransform>

namespace divot::viewer {

BodyNode::BodyNode(osg::ref_ptr<osg::Node> sphere) : sphere_(std::move(sphere)), root_(new osg::Group) {}

void BodyNode::update(const Vec3d& origin, std::span<const BodyView> bodies) {
  // Bodies are never removed from a world, so child i is body i; another world may have fewer.
  const auto count = static_cast<unsigned>(bodies.size());
  if (root_->getNumChildren() > count) root_->removeChildren(count, root_->getNumChildren() - count);
  while (root_->getNumChildren() < count) {
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform;
    place->addChild(sphere_);
    root_->addChild(place);
  }
  for (unsigned i = 0; i < count; ++i) {
    const BodyView& body = bodies[i];
    const Vec3d p = body.position - origin;
    const Quat& q = body.orientation;
    auto* place = static_cast<osg::MatrixTransform*>(root_->getChild(i));
    place->setMatrix(osg::Matrixd::scale(body.radius, body.radius, body.radius) *
                     osg::Matrixd::rotate(osg::Quat(q.x, q.y, q.z, q.w)) * osg::Matrixd::translate(p.x, p.y, p.z));
  }
}

}  // namespace divot::viewer
