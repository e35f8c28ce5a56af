#include "viewer/shrink.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace divot::viewer {
namespace {

// What a pixel of the small side covers of the large one: pixels from `first` on, each by a share; shares sum to 1.
struct Cover {
  int first = 0;
  std::vector<float> shares = {};
};

std::vector<Cover> covers(int large, int small) {
  std::vector<Cover> all(static_cast<std::size_t>(small));
  const double step = static_cast<double>(large) / small;
  for (int k = 0; k < small; ++k) {
    Cover& cover = all[static_cast<std::size_t>(k)];
    const double begin = k * step, end = std::min((k + 1) * step, static_cast<double>(large));
    cover.first = static_cast<int>(begin);
    for (int i = cover.first; i < end; ++i) {
      cover.shares.push_back(static_cast<float>((std::min<double>(i + 1, end) - std::max<double>(i, begin)) / step));
    }
  }
  return all;
}

}  // namespace

Image shrink(const Image& image, int width) {
  if (width >= image.width) return image;
  const auto in_proportion = static_cast<int>(std::lround(static_cast<double>(image.height) * width / image.width));
  Image out{.width = width, .height = std::max(1, in_proportion)};
  const std::vector<Cover> columns = covers(image.width, out.width), rows = covers(image.height, out.height);
  out.rgb.reserve(3 * columns.size() * rows.size());
  for (const Cover& row : rows) {
    for (const Cover& column : columns) {
      std::array<float, 3> sum = {0.5f, 0.5f, 0.5f};  // rounds
      for (std::size_t j = 0; j < row.shares.size(); ++j) {
        const std::size_t line = (static_cast<std::size_t>(row.first) + j) * static_cast<std::size_t>(image.width);
        for (std::size_t i = 0; i < column.shares.size(); ++i) {
          const std::size_t pixel = 3 * (line + static_cast<std::size_t>(column.first) + i);
          for (std::size_t c = 0; c < 3; ++c) sum[c] += row.shares[j] * column.shares[i] * image.rgb[pixel + c];
        }
      }
      for (const float channel : sum) out.rgb.push_back(static_cast<std::uint8_t>(std::min(channel, 255.0f)));
    }
  }
  return out;
}

}  // namespace divot::viewer
