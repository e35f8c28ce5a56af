#include "viewer/caption.h"

#include "viewer/overlay.h"

namespace divot::viewer {
namespace {

constexpr float kSize = 0.042f;  // of the letters over the picture's height

}  // namespace

Caption::Caption(int width, int height, bool dark) : overlay_(make_overlay(width, height)) {
  const float size = kSize * static_cast<float>(height);
  text_ = make_text(size, dark ? osg::Vec4(0.12f, 0.14f, 0.18f, 1) : osg::Vec4(1, 1, 1, 1));
  text_->setFontResolution(static_cast<unsigned>(2 * size), static_cast<unsigned>(2 * size));
  text_->setPosition(osg::Vec3(0.8f * size, 0.8f * size, 0));
  // A plate behind the letters keeps them readable on any ground.
  text_->setDrawMode(osgText::Text::TEXT | osgText::Text::FILLEDBOUNDINGBOX);
  text_->setBoundingBoxColor(dark ? osg::Vec4(0.972f, 0.972f, 0.962f, 0.85f) : osg::Vec4(0.07f, 0.09f, 0.12f, 0.6f));
  text_->setBoundingBoxMargin(0.35f * size);
  overlay_->addChild(text_);
}

void Caption::set_text(const std::string& text) { viewer::set_text(*text_, text); }

}  // namespace divot::viewer
