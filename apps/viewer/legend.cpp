#include "viewer/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace divot::viewer {
namespace {

constexpr float kSize = 0.030f, kLeastSize = 8;  // of the letters, over the picture's height; pixels
// In letters' sizes.
constexpr float kLine = 1.45f, kMargin = 0.8f, kPad = 0.6f, kSwatch = 1.7f, kGap = 0.7f, kLetter = 0.62f;

const osg::Vec4 kPlate(0.07f, 0.09f, 0.12f, 0.6f), kText(1, 1, 1, 1);

// What stands beside the stops, from the top down: the largest number first, names in their order.
struct Row {
  std::size_t stop;
  std::string text;
};

std::vector<Row> rows_of(const ColorScale& scale, double offset) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < scale.labels.size(); ++i) rows.push_back({i, scale.labels[i]});
  if (!rows.empty()) return rows;
  for (std::size_t i = kScaleStops; i-- > 0;) {
    const double share = static_cast<double>(i) / (kScaleStops - 1);
    // The 0 keeps a minus away from zero.
    rows.push_back({i, fmt::format("{:.4g}", scale.low + share * (scale.high - scale.low) + offset + 0.0)});
  }
  return rows;
}

}  // namespace

Legend::Legend(int width, int height)
    : overlay_(make_overlay(width, height)),
      width_(static_cast<float>(width)),
      height_(static_cast<float>(height)),
      size_(std::max(kLeastSize, std::round(kSize * height_))) {
  overlay_->addChild(&plates_.root());
}

void Legend::show(const ColorScale& scale, double offset) {
  plates_.clear();
  used_labels_ = 0;
  if (!scale.title.empty()) {
    const std::vector<Row> rows = rows_of(scale, offset);
    std::size_t letters = scale.title.size();
    for (const Row& row : rows) letters = std::max(letters, row.text.size() + 4);  // beside its colour
    const float line = std::round(kLine * size_), pad = kPad * size_, margin = kMargin * size_;
    const float plate_width = static_cast<float>(letters) * kLetter * size_ + 2 * pad;
    const float plate_height = static_cast<float>(rows.size() + 1) * line + 2 * pad;
    const float left = width_ - margin - plate_width, top = height_ - margin;
    plates_.add(left, top - plate_height, plate_width, plate_height, kPlate);
    float y = top - pad - size_;
    write(left + pad, y, scale.title);
    for (const Row& row : rows) {
      y -= line;
      const ColorScale::Rgb& c = scale.stops[row.stop];
      plates_.add(left + pad, y - 0.3f * size_, kSwatch * size_, line, osg::Vec4(c[0], c[1], c[2], 1));
      write(left + pad + (kSwatch + kGap) * size_, y, row.text);
    }
  }
  plates_.finish();
  for (std::size_t i = 0; i < labels_.size(); ++i) labels_[i]->setNodeMask(i < used_labels_ ? ~0u : 0u);
}

void Legend::write(float x, float y, const std::string& content) {
  if (used_labels_ == labels_.size()) {
    labels_.push_back(make_text(size_, kText));
    labels_.back()->setFontResolution(static_cast<unsigned>(2 * size_), static_cast<unsigned>(2 * size_));
    overlay_->addChild(labels_.back());
  }
  osgText::Text& text = *labels_[used_labels_++];
  set_text(text, content);
  // Whole pixels keep letters sharp.
  text.setPosition(osg::Vec3(std::round(x), std::round(y), 0));
}

}  // namespace divot::viewer
