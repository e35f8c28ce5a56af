#include "viewer/box_node.h"

#include "viewer/shaders.h"

namespace divot::viewer {
namespace {

const osg::Vec4 kColor(0.95f, 0.80f, 0.15f, 1);

}  // namespace

BoxNode::BoxNode()
    : lines_(new osg::Geometry), corners_(new osg::Vec3Array), edges_(new osg::DrawElementsUInt(GL_LINES)) {
  lines_->setDataVariance(osg::Object::DYNAMIC);
  lines_->setUseDisplayList(false);
  lines_->setUseVertexBufferObjects(true);
  lines_->setVertexArray(corners_);
  osg::ref_ptr<osg::Vec4Array> color = new osg::Vec4Array(1);
  color->front() = kColor;
  lines_->setColorArray(color, osg::Array::BIND_OVERALL);
  lines_->addPrimitiveSet(edges_);
  lines_->getOrCreateStateSet()->setAttributeAndModes(point_program());
  lines_->getOrCreateStateSet()->addUniform(new osg::Uniform("point_size", 0.0f));
}

// Corner k of a box takes its greatest x where bit 0 of k is set, y for bit 1, z for bit 2; edges change one bit.
void BoxNode::update(std::span<const std::pair<Vec3, Vec3>> boxes) {
  corners_->clear();
  edges_->clear();
  for (const auto& [least, greatest] : boxes) {
    const auto first = static_cast<unsigned>(corners_->size());
    for (unsigned k = 0; k < 8; ++k) {
      corners_->push_back(
          osg::Vec3(k & 1 ? greatest.x : least.x, k & 2 ? greatest.y : least.y, k & 4 ? greatest.z : least.z));
      for (const unsigned bit : {1u, 2u, 4u}) {
        if (k & bit) continue;
        edges_->push_back(first + k);
        edges_->push_back(first + (k | bit));
      }
    }
  }
  corners_->dirty();
  edges_->dirty();
  lines_->dirtyBound();
}

}  // namespace divot::viewer
