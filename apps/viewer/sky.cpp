#include "viewer/sky.h"

#include <osg/Depth>

#include "viewer/shaders.h"

namespace divot::viewer {
namespace {

constexpr int kRows = 16;  // colours are worked out at their edges

// No bounds: the quad must not pull the far plane to itself.
struct NoBounds : osg::Drawable::ComputeBoundingBoxCallback {
  osg::BoundingBox computeBound(const osg::Drawable&) const override { return {}; }
};

}  // namespace

osg::ref_ptr<osg::Geometry> make_background(const osg::Vec3& top, const osg::Vec3& bottom, Quality quality) {
  osg::ref_ptr<osg::Geometry> quad = new osg::Geometry;
  osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
  for (int row = 0; row <= kRows; ++row) {
    const double y = 2.0 * row / kRows - 1;
    corners->push_back(osg::Vec3d(-1, y, 1));
    corners->push_back(osg::Vec3d(1, y, 1));
  }
  quad->setUseDisplayList(false);
  quad->setUseVertexBufferObjects(true);
  quad->setVertexArray(corners);
  quad->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, 2 * (kRows + 1)));
  quad->setCullingActive(false);
  quad->setComputeBoundingBoxCallback(new NoBounds);

  osg::StateSet* state = quad->getOrCreateStateSet();
  state->setAttributeAndModes(background_program(quality));
  // After what is solid, so that only the pixels that show it are coloured; before what is transparent.
  state->setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0, 1, false));
  state->setRenderBinDetails(5, "RenderBin");
  state->addUniform(new osg::Uniform("background_top", top));
  state->addUniform(new osg::Uniform("background_bottom", bottom));
  return quad;
}

}  // namespace divot::viewer
