#include "viewer/soil_looks.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <osg/Notify>
#include <osgDB/ReadFile>

#include "viewer/color_scale.h"
#include "viewer/shaders.h"
#include "viewer/textures.h"

namespace divot::viewer {
namespace {

// Light comes on top: white that is lit fully would be too bright. The same share is in the shaders for pictures.
constexpr float kAlbedo = 0.75f;

constexpr std::size_t kMostMaterials = 256;  // SurfaceView::materials holds bytes

osg::ref_ptr<osg::Image> picture_of(const Material& material, const std::string& folder) {
  if (material.texture.empty()) return {};
  // What cannot be read is told by check_textures() and not by OpenSceneGraph.
  const osg::NotifySeverity before = osg::getNotifyLevel();
  osg::setNotifyLevel(osg::ALWAYS);
  osg::ref_ptr<osg::Image> picture =
      osgDB::readRefImageFile((std::filesystem::path(folder) / material.texture).string());
  osg::setNotifyLevel(before);
  return picture;
}

}  // namespace

osg::Vec3 color_of(const std::string& text) {
  if (text.size() != 7) return {1, 1, 1};
  const unsigned long rgb = std::strtoul(text.c_str() + 1, nullptr, 16);
  const auto channel = [&](int shift) { return static_cast<float>(rgb >> shift & 255) / 255; };
  return {channel(16), channel(8), channel(0)};
}

osg::ref_ptr<osg::Texture2D> texture_of(const Material& material, const std::string& folder) {
  const osg::ref_ptr<osg::Image> picture = picture_of(material, folder);
  if (!picture) return {};
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(picture);
  texture->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
  texture->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_LINEAR);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  texture->setResizeNonPowerOfTwoHint(false);
  return texture;
}

std::vector<osg::ref_ptr<osg::StateSet>> soil_looks(std::span<const Material> materials, const std::string& folder) {
  std::vector<osg::ref_ptr<osg::StateSet>> looks;
  const Material plain;
  while (looks.size() < kMostMaterials) {
    const Material& material = looks.size() < materials.size() ? materials[looks.size()] : plain;
    osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
    state->setDefine("SOIL");
    state->addUniform(new osg::Uniform("material_number", static_cast<float>(looks.size() % kScaleStops)));
    if (const auto texture = texture_of(material, folder)) {
      state->setDefine("SOIL_TEXTURE");
      state->setTextureAttributeAndModes(kSoilUnit, texture);
      state->addUniform(new osg::Uniform("soil_texture", static_cast<int>(kSoilUnit)));
      state->addUniform(new osg::Uniform("soil_repeats", static_cast<float>(1 / material.texture_size)));
      const double texels = std::max(texture->getImage()->s(), texture->getImage()->t());
      state->addUniform(new osg::Uniform("soil_texels", static_cast<float>(texels / material.texture_size)));
    } else if (!material.color.empty()) {
      state->setDefine("SOIL_COLOR");
      osg::Vec3 color = color_of(material.color);
      for (int k = 0; k < 3; ++k) color[k] = kAlbedo * std::pow(color[k], 2.2f);
      state->addUniform(new osg::Uniform("soil_color", color));
    }
    looks.push_back(state);
  }
  return looks;
}

Result<void> check_textures(std::span<const Material> materials, const std::string& folder) {
  Errors errors;
  for (const Material& material : materials) {
    if (material.texture.empty() || picture_of(material, folder)) continue;
    errors.push_back({.key = fmt::format("materials.{}.texture", material.name),
                      .problem = fmt::format("\"{}\" is no picture that can be read", material.texture),
                      .expected = "expected a PNG or JPEG file"});
  }
  if (errors.empty()) return {};
  return tl::unexpected(std::move(errors));
}

}  // namespace divot::viewer
