#include "viewer/image.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <osg/Image>
#include <osgDB/Registry>
#include <system_error>

#include "viewer/failure.h"

namespace divot::viewer {
namespace {

tl::unexpected<Errors> cannot_write(const std::string& path, std::string problem, std::string expected) {
  return failure(std::move(problem), std::move(expected), {}, path);
}

bool is_complete(const Image& image) {
  return image.width > 0 && image.height > 0 &&
         image.rgb.size() == 3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
}

// OpenSceneGraph keeps its bottom row first.
osg::ref_ptr<osg::Image> to_osg(const Image& image) {
  osg::ref_ptr<osg::Image> out = new osg::Image;
  out->allocateImage(image.width, image.height, 1, GL_RGB, GL_UNSIGNED_BYTE);
  const std::size_t stride = 3 * static_cast<std::size_t>(image.width);
  for (int row = 0; row < image.height; ++row) {
    const auto* source = image.rgb.data() + stride * static_cast<std::size_t>(row);
    std::copy_n(source, stride, out->data(0, static_cast<unsigned>(image.height - 1 - row)));
  }
  return out;
}

// Copies `image` into `sheet` with its upper left corner at x, y; it must fit.
void paste(const Image& image, int x, int y, Image& sheet) {
  const std::size_t stride = 3 * static_cast<std::size_t>(image.width);
  for (int row = 0; row < image.height; ++row) {
    const std::size_t target = 3 * (static_cast<std::size_t>(y + row) * static_cast<std::size_t>(sheet.width) + x);
    std::copy_n(image.rgb.data() + stride * static_cast<std::size_t>(row), stride, sheet.rgb.data() + target);
  }
}

}  // namespace

Result<void> write_png(const Image& image, const std::string& path) {
  if (!is_complete(image)) return cannot_write(path, "the picture is empty", "at least one pixel");
  osgDB::ReaderWriter* png = osgDB::Registry::instance()->getReaderWriterForExtension("png");
  if (!png) return cannot_write(path, "OpenSceneGraph has no PNG plugin here", "the package libopenscenegraph161");

  const std::string partial = path + ".part";
  std::ofstream stream(partial, std::ios::binary);
  if (!stream) return cannot_write(path, "cannot be written", "a folder that exists and may be written to");
  const bool encoded = png->writeImage(*to_osg(image), stream).success();
  stream.close();

  std::error_code problem;
  if (encoded && stream) std::filesystem::rename(partial, path, problem);
  if (encoded && stream && !problem) return {};
  const std::string why = problem ? "cannot be written: " + problem.message() : "cannot be written completely";
  std::filesystem::remove(partial, problem);
  return cannot_write(path, why, "free space and the right to write there");
}

Result<Image> contact_sheet(std::span<const Image> images, const SheetLayout& layout) {
  if (images.empty()) return failure("no pictures for a sheet", "at least one");
  if (layout.columns < 1 || layout.margin < 0) {
    return failure("sheet layout out of range", "columns >= 1 and margin >= 0");
  }
  int width = 0, height = 0;
  for (const Image& image : images) {
    if (!is_complete(image)) return failure("a picture of the sheet is empty", "rendered pictures");
    width = std::max(width, image.width);
    height = std::max(height, image.height);
  }

  // Cells of one size, separated by the margin; a last row that is not full stands in the middle.
  const int count = static_cast<int>(images.size());
  const int columns = std::min(layout.columns, count), rows = (count + columns - 1) / columns;
  Image sheet{.width = layout.margin + columns * (width + layout.margin),
              .height = layout.margin + rows * (height + layout.margin)};
  sheet.rgb.assign(3 * static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height), 255);
  for (int i = 0; i < count; ++i) {
    const int missing = i / columns == rows - 1 ? rows * columns - count : 0;
    const int x = layout.margin + (i % columns) * (width + layout.margin) + missing * (width + layout.margin) / 2;
    const int y = layout.margin + (i / columns) * (height + layout.margin);
    paste(images[static_cast<std::size_t>(i)], x, y, sheet);
  }
  return sheet;
}

Result<void> write_contact_sheet(std::span<const Image> images, const SheetLayout& layout, const std::string& path) {
  return contact_sheet(images, layout).and_then([&](const Image& sheet) { return write_png(sheet, path); });
}

}  // namespace divot::viewer
