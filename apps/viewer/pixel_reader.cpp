#include "viewer/pixel_reader.h"

#include <algorithm>
#include <osg/RenderInfo>

namespace divot::viewer {

// OpenGL's first row is the lowest.
void PixelReader::operator()(osg::RenderInfo& info) const {
  const osg::Viewport& view = *info.getCurrentCamera()->getViewport();
  image_.width = static_cast<int>(view.width());
  image_.height = static_cast<int>(view.height());
  const std::size_t stride = 3 * static_cast<std::size_t>(image_.width);
  image_.rgb.resize(stride * static_cast<std::size_t>(image_.height));
  glReadBuffer(GL_BACK);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, image_.width, image_.height, GL_RGB, GL_UNSIGNED_BYTE, image_.rgb.data());
  auto top = image_.rgb.begin(), bottom = image_.rgb.end() - static_cast<std::ptrdiff_t>(stride);
  for (; top < bottom; top += static_cast<std::ptrdiff_t>(stride), bottom -= static_cast<std::ptrdiff_t>(stride)) {
    std::swap_ranges(top, top + static_cast<std::ptrdiff_t>(stride), bottom);
  }
}

}  // namespace divot::viewer
