#include "viewer/grain.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace divot::viewer {
namespace {

constexpr unsigned kSize = 1024;  // texels
// Cells along the texture of the longest and the shortest wave.
constexpr unsigned kBroad[] = {4, 32}, kFine[] = {36, 288};

float hash(std::uint32_t x, std::uint32_t y) {
  std::uint32_t h = x * 0x8da6b343u ^ y * 0xd8163841u;
  h = (h ^ (h >> 13)) * 0x5bd1e995u;
  return static_cast<float>((h ^ (h >> 15)) & 0xffffffu) / 16777215.0f;
}

float blend(float a, float b, float t) { return a + (b - a) * t * t * (3 - 2 * t); }

// Value noise that repeats after `cells`; u and v in texels.
float noise(unsigned u, unsigned v, unsigned cells) {
  const float x = static_cast<float>(u * cells) / kSize, y = static_cast<float>(v * cells) / kSize;
  const auto i = static_cast<unsigned>(x), j = static_cast<unsigned>(y);
  const auto corner = [&](unsigned a, unsigned b) { return hash((a % cells) + 31 * cells, b % cells); };
  const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
  return blend(blend(corner(i, j), corner(i + 1, j), fx), blend(corner(i, j + 1), corner(i + 1, j + 1), fx), fy) - 0.5f;
}

unsigned char octaves(unsigned u, unsigned v, const unsigned (&cells)[2]) {
  float sum = 0.5f, weight = 0.5f;
  for (unsigned c = cells[0]; c <= cells[1]; c *= 2, weight *= 0.66f) sum += weight * noise(u, v, c);
  return static_cast<unsigned char>(std::lround(255 * std::clamp(sum, 0.0f, 1.0f)));
}

}  // namespace

osg::ref_ptr<osg::Texture2D> make_grain() {
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(kSize, kSize, 1, GL_LUMINANCE_ALPHA, GL_UNSIGNED_BYTE);
  for (unsigned v = 0; v < kSize; ++v) {
    for (unsigned u = 0; u < kSize; ++u) {
      image->data(u, v)[0] = octaves(u, v, kBroad);
      image->data(u, v)[1] = octaves(u, v, kFine);
    }
  }
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
  texture->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
  texture->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_NEAREST);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  return texture;
}

}  // namespace divot::viewer
