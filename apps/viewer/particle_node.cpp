#include "viewer/particle_node.h"

#include "viewer/shaders.h"

namespace divot::viewer {
namespace {

const osg::Vec4ub kMoving(255, 140, 20, 255), kFixed(60, 110, 220, 255);
constexpr double kShareOfSpacing = 160;  // pixels on a screen 2 units high, for points a third of the spacing wide

}  // namespace

ParticleNode::ParticleNode()
    : points_(new osg::Geometry),
      positions_(new osg::Vec3Array),
      colors_(new osg::Vec4ubArray),
      drawn_(new osg::DrawArrays(GL_POINTS, 0, 0)),
      size_(new osg::Uniform("point_size", 1.0f)) {
  points_->setDataVariance(osg::Object::DYNAMIC);
  points_->setUseDisplayList(false);
  points_->setUseVertexBufferObjects(true);
  points_->setVertexArray(positions_);
  colors_->setNormalize(true);
  points_->setColorArray(colors_, osg::Array::BIND_PER_VERTEX);
  points_->addPrimitiveSet(drawn_);
  osg::StateSet* state = points_->getOrCreateStateSet();
  state->setAttributeAndModes(point_program());
  state->setMode(GL_VERTEX_PROGRAM_POINT_SIZE, osg::StateAttribute::ON);
  state->addUniform(size_);
}

void ParticleNode::update(const ParticleView& particles, double spacing) {
  const std::size_t count = particles.vertices.size();
  positions_->resize(count);
  colors_->resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    (*positions_)[i].set(particles.x[i], particles.y[i], particles.z[i]);
    (*colors_)[i] = particles.hold[i] == Hold::anchor ? kFixed : kMoving;
  }
  positions_->dirty();
  colors_->dirty();
  drawn_->setCount(static_cast<GLsizei>(count));
  drawn_->dirty();
  points_->dirtyBound();
  size_->set(static_cast<float>(kShareOfSpacing * spacing));
}

}  // namespace divot::viewer
