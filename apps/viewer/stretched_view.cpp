#include "viewer/stretched_view.h"

#include <algorithm>
#include <cmath>
#include <osg/Depth>
#include <osg/Geometry>
#include <osg/Texture2D>

#include "viewer/shaders.h"

namespace divot::viewer {
namespace {

osg::ref_ptr<osg::Texture2D> make_target(int width, int height) {
  osg::ref_ptr<osg::Texture2D> target = new osg::Texture2D;
  target->setTextureSize(width, height);
  target->setResizeNonPowerOfTwoHint(false);
  target->setInternalFormat(GL_RGBA8);
  target->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
  target->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  target->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
  target->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
  return target;
}

// Draws with the eye of the camera above it.
osg::ref_ptr<osg::Camera> make_pass(osg::Node& scene, osg::Texture2D& target) {
  osg::ref_ptr<osg::Camera> pass = new osg::Camera;
  pass->setRenderOrder(osg::Camera::PRE_RENDER);
  pass->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  pass->setViewport(0, 0, target.getTextureWidth(), target.getTextureHeight());
  pass->setClearMask(GL_DEPTH_BUFFER_BIT);  // the background covers every pixel
  pass->attach(osg::Camera::COLOR_BUFFER, &target);
  pass->attach(osg::Camera::DEPTH_BUFFER, GL_DEPTH_COMPONENT24);
  pass->addChild(&scene);
  return pass;
}

osg::ref_ptr<osg::Geometry> make_sheet(osg::Texture2D& picture) {
  osg::ref_ptr<osg::Geometry> sheet = new osg::Geometry;
  osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
  for (const auto& [x, y] : {std::pair(-1.0f, -1.0f), {1.0f, -1.0f}, {-1.0f, 1.0f}, {1.0f, 1.0f}}) {
    corners->push_back(osg::Vec3(x, y, 0));
  }
  sheet->setUseDisplayList(false);
  sheet->setUseVertexBufferObjects(true);
  sheet->setVertexArray(corners);
  sheet->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_STRIP, 0, 4));
  sheet->setCullingActive(false);
  osg::StateSet* state = sheet->getOrCreateStateSet();
  state->setAttributeAndModes(stretch_program());
  state->setTextureAttributeAndModes(0, &picture);
  state->addUniform(new osg::Uniform("picture", 0));
  state->setAttributeAndModes(new osg::Depth(osg::Depth::ALWAYS, 0, 1, false));
  return sheet;
}

int part(int pixels, double share) { return std::max(static_cast<int>(std::lround(pixels * share)), 1); }

}  // namespace

StretchedView::StretchedView(osg::Node& scene) : scene_(&scene), root_(new osg::Group) {}

void StretchedView::set_size(int width, int height, double share) {
  if (width == width_ && height == height_ && share == share_) return;
  width_ = width;
  height_ = height;
  share_ = share;
  root_->removeChildren(0, root_->getNumChildren());
  if (share == 1) {
    root_->addChild(scene_);
  } else {
    stretch(part(width, share), part(height, share));
  }
}

void StretchedView::stretch(int width, int height) {
  const osg::ref_ptr<osg::Texture2D> target = make_target(width, height);
  root_->addChild(make_pass(*scene_, *target));
  root_->addChild(make_sheet(*target));
}

}  // namespace divot::viewer
