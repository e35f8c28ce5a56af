#include "viewer/overlay.h"

#include <cmath>
#include <filesystem>
#include <osg/BlendFunc>
#include <osgText/Font>

#include "viewer/shaders.h"

namespace divot::viewer {
namespace {

constexpr char kFont[] = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";  // of the package fonts-dejavu-core

}  // namespace

osg::ref_ptr<osg::Camera> make_overlay(int width, int height) {
  osg::ref_ptr<osg::Camera> overlay = new osg::Camera;
  overlay->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  overlay->setProjectionMatrixAsOrtho2D(0, width, 0, height);
  overlay->setViewMatrix(osg::Matrixd::identity());
  overlay->setClearMask(0);  // nothing in it asks for depth
  overlay->setRenderOrder(osg::Camera::POST_RENDER);
  overlay->setAllowEventFocus(false);
  overlay->getOrCreateStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
  return overlay;
}

osg::ref_ptr<osgText::Text> make_text(float size, const osg::Vec4& color) {
  osg::ref_ptr<osgText::Text> text = new osgText::Text;
  // OpenSceneGraph's own font serves where the package is not installed; asking for a missing file would print a
  // warning.
  std::error_code missing;
  if (std::filesystem::exists(kFont, missing)) text->setFont(kFont);
  // Letters face the eye. Software renderers would still pay for looking at them from the side.
  if (text->getFont()) text->getFont()->setMaxAnisotropy(1);
  text->setShaderTechnique(osgText::NO_TEXT_SHADER);
  text->setCharacterSize(size);
  const auto resolution = static_cast<unsigned>(std::lround(size));
  text->setFontResolution(resolution, resolution);
  text->setColor(color);
  text->setDataVariance(osg::Object::DYNAMIC);
  return text;
}

void set_text(osgText::Text& text, const std::string& content) {
  const osgText::String encoded(content, osgText::String::ENCODING_UTF8);
  if (text.getText() != encoded) text.setText(encoded);
}

Plates::Plates()
    : geometry_(new osg::Geometry),
      corners_(new osg::Vec3Array),
      colors_(new osg::Vec4Array),
      drawn_(new osg::DrawArrays(GL_QUADS, 0, 0)) {
  geometry_->setDataVariance(osg::Object::DYNAMIC);
  geometry_->setUseDisplayList(false);
  geometry_->setUseVertexBufferObjects(true);
  geometry_->setVertexArray(corners_);
  geometry_->setColorArray(colors_, osg::Array::BIND_PER_VERTEX);
  geometry_->addPrimitiveSet(drawn_);
  geometry_->setCullingActive(false);
  osg::StateSet* state = geometry_->getOrCreateStateSet();
  state->setAttributeAndModes(point_program());
  state->addUniform(new osg::Uniform("point_size", 0.0f));
  state->setAttributeAndModes(new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA));
  // Before the letters on it.
  state->setRenderBinDetails(-1, "RenderBin");
}

void Plates::clear() {
  corners_->clear();
  colors_->clear();
}

void Plates::add(float x, float y, float width, float height, const osg::Vec4& color) {
  for (const auto& [right, up] : {std::pair(0.0f, 0.0f), {width, 0.0f}, {width, height}, {0.0f, height}}) {
    corners_->push_back(osg::Vec3(x + right, y + up, 0));
    colors_->push_back(color);
  }
}

void Plates::finish() {
  corners_->dirty();
  colors_->dirty();
  drawn_->setCount(static_cast<GLsizei>(corners_->size()));
  drawn_->dirty();
  geometry_->dirtyBound();
}

}  // namespace divot::viewer
