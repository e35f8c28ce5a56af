#include "viewer/body_node.h"

#include "viewer/shape_mesh.h"

namespace divot::viewer {

double ball_radius(const BodyView& body) {
  if (!body.shape) return body.radius;
  const auto* ball = std::get_if<Sphere>(&*body.shape);
  return ball ? ball->radius : 0;
}

BodyNode::BodyNode(osg::ref_ptr<osg::Node> sphere)
    : sphere_(std::move(sphere)), root_(new osg::Group), balls_(new osg::Group), solids_(new osg::Group) {
  root_->addChild(balls_);
  root_->addChild(solids_);
}

void BodyNode::update(const Vec3d& origin, std::span<const BodyView> bodies) {
  // Bodies are never removed from a world; another world may have fewer, or others.
  for (std::size_t i = bodies.size(); i < places_.size(); ++i) {
    balls_->removeChild(places_[i].node);
    solids_->removeChild(places_[i].node);
  }
  places_.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodyView& body = bodies[i];
    const Vec3d p = body.position - origin;
    const Quat& q = body.orientation;
    const double ball = ball_radius(body), size = ball > 0 ? ball : 1;
    Place& place = places_[i];
    if (!place.node || place.shape != body.shape) make_place(place, body.shape);
    place.node->setMatrix(osg::Matrixd::scale(size, size, size) * osg::Matrixd::rotate(osg::Quat(q.x, q.y, q.z, q.w)) *
                          osg::Matrixd::translate(p.x, p.y, p.z));
  }
}

void BodyNode::make_place(Place& place, const std::shared_ptr<const Shape>& shape) {
  if (place.node) {
    balls_->removeChild(place.node);
    solids_->removeChild(place.node);
  }
  place = {shape, new osg::MatrixTransform};
  const bool ball = !shape || std::holds_alternative<Sphere>(*shape);
  place.node->addChild(ball ? sphere_ : make_shape(*shape, *sphere_));
  (ball ? balls_ : solids_)->addChild(place.node);
}

void BodyNode::hide(std::uint32_t body) { places_[body].node->setNodeMask(0); }

}  // namespace divot::viewer
