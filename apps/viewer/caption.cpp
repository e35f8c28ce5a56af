#include "viewer/caption.h"

#include <filesystem>
#include <osgText/Font>

namespace divot::viewer {
namespace {

constexpr char kFont[] = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";  // of the package fonts-dejavu-core
constexpr float kSize = 0.042f;                                              // of the letters over the picture's height

}  // namespace

Caption::Caption(int width, int height, bool dark) : overlay_(new osg::Camera), text_(new osgText::Text) {
  overlay_->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  overlay_->setProjectionMatrixAsOrtho2D(0, width, 0, height);
  overlay_->setViewMatrix(osg::Matrixd::identity());
  overlay_->setClearMask(GL_DEPTH_BUFFER_BIT);
  overlay_->setRenderOrder(osg::Camera::POST_RENDER);
  overlay_->setAllowEventFocus(false);
  overlay_->getOrCreateStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);

  // OpenSceneGraph's own font serves where the package is not installed; asking for a missing file would print a
  // warning.
  std::error_code missing;
  if (std::filesystem::exists(kFont, missing)) text_->setFont(kFont);
  const float size = kSize * static_cast<float>(height);
  text_->setCharacterSize(size);
  text_->setFontResolution(static_cast<unsigned>(2 * size), static_cast<unsigned>(2 * size));
  text_->setPosition(osg::Vec3(0.8f * size, 0.8f * size, 0));
  text_->setColor(dark ? osg::Vec4(0.12f, 0.14f, 0.18f, 1) : osg::Vec4(1, 1, 1, 1));
  // A plate behind the letters keeps them readable on any ground.
  text_->setDrawMode(osgText::Text::TEXT | osgText::Text::FILLEDBOUNDINGBOX);
  text_->setBoundingBoxColor(dark ? osg::Vec4(0.972f, 0.972f, 0.962f, 0.85f) : osg::Vec4(0.07f, 0.09f, 0.12f, 0.6f));
  text_->setBoundingBoxMargin(0.35f * size);
  text_->setDataVariance(osg::Object::DYNAMIC);
  overlay_->addChild(text_);
}

void Caption::set_text(const std::string& text) { text_->setText(text, osgText::String::ENCODING_UTF8); }

}  // namespace divot::viewer
