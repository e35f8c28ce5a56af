#include "viewer/hud.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viewer/input.h"

namespace divot::viewer {
namespace {

constexpr float kSize = 13, kLine = 18, kMargin = 10, kPad = 8;  // pixels
constexpr float kStatusWidth = 250, kHelpWidth = 520, kHelpText = 96, kLegendWidth = 190;
constexpr float kNameWidth = 92, kBarWidth = 72;
constexpr double kFullBar = 1000.0 / 60;  // ms
constexpr double kRenewal = 0.2;          // s

const osg::Vec4 kPlate(0.05f, 0.07f, 0.10f, 0.62f), kDarkPlate(0.05f, 0.07f, 0.10f, 0.86f);
const osg::Vec4 kText(0.94f, 0.95f, 0.96f, 1), kFaint(0.66f, 0.70f, 0.75f, 1), kWarning(1.0f, 0.72f, 0.25f, 1);
const osg::Vec4 kBar(0.35f, 0.68f, 0.95f, 1), kGroove(1, 1, 1, 0.10f), kDrawing(0.55f, 0.80f, 0.45f, 1);

// Times, counts and charges in as few letters as they need.
std::string bytes(double count) {
  if (count < 1e3) return fmt::format("{:.0f} B", count);
  return count < 1e6 ? fmt::format("{:.1f} kB", count / 1e3) : fmt::format("{:.1f} MB", count / 1e6);
}

std::string charge(double tons) {
  return tons < 1000 ? fmt::format("{:g} t", tons) : fmt::format("{:g} kt", tons / 1000);
}

std::string marks(const HudValues& v) {
  std::string text = v.paused ? "paused" : v.lagging ? "too slow: time lags" : "";
  if (v.speed < 1) text += fmt::format("{}1/{:.0f} speed", text.empty() ? "" : ", ", 1 / v.speed);
  return text;
}

}  // namespace

Hud::Hud() : overlay_(make_overlay(1, 1)) { overlay_->addChild(&plates_.root()); }

void Hud::resize(int width, int height) {
  width_ = static_cast<float>(width);
  height_ = static_cast<float>(height);
  overlay_->setProjectionMatrixAsOrtho2D(0, width, 0, height);
  next_renewal_ = 0;
}

void Hud::update(const HudValues& values, double now) {
  const bool asked = values.help != help_ || values.message != message_;
  if (now < next_renewal_ && !asked) return;
  next_renewal_ = now + kRenewal;
  help_ = values.help;
  message_ = values.message;
  used_labels_ = 0;
  plates_.clear();
  draw_status(values);
  draw_stages(values);
  draw_tools(values);
  draw_legend(values);
  if (values.help) draw_help();
  plates_.finish();
  for (std::size_t i = 0; i < labels_.size(); ++i) labels_[i]->setNodeMask(i < used_labels_ ? ~0u : 0u);
}

void Hud::write(float x, float y, const std::string& content, const osg::Vec4& color, bool right_aligned) {
  if (used_labels_ == labels_.size()) {
    labels_.push_back(make_text(kSize, color));
    overlay_->addChild(labels_.back());
  }
  osgText::Text& text = *labels_[used_labels_++];
  set_text(text, content);
  if (text.getColor() != color) text.setColor(color);
  const auto alignment = right_aligned ? osgText::Text::RIGHT_BASE_LINE : osgText::Text::LEFT_BASE_LINE;
  if (text.getAlignment() != alignment) text.setAlignment(alignment);
  // Whole pixels keep letters sharp.
  const osg::Vec3 place(std::round(x), std::round(y), 0);
  if (text.getPosition() != place) text.setPosition(place);
}

void Hud::draw_status(const HudValues& v) {
  const std::string state = marks(v);
  const float lines = state.empty() ? 3 : 4, height = lines * kLine + kPad, left = kMargin + kPad;
  const float right = kMargin + kStatusWidth - kPad;
  plates_.add(kMargin, height_ - kMargin - height, kStatusWidth, height, kPlate);
  float y = height_ - kMargin - kLine + 2;
  write(left, y, fmt::format("t = {:.2f} s", v.time), kText);
  write(right, y, fmt::format("{:.2f}x real time", v.real_time_factor), v.lagging ? kWarning : kText, true);
  y -= kLine;
  write(left, y, fmt::format("{} awake", v.awake), kText);
  write(right, y, fmt::format("{:.0f} pictures/s", v.pictures_per_second), kText, true);
  y -= kLine;
  write(left, y, fmt::format("sent to card: {} a picture", bytes(v.uploaded)), kFaint);
  if (!state.empty()) write(left, y - kLine, state, kWarning);
}

// Milliseconds a picture, as bars that are full when nothing else fits into a sixtieth of a second.
void Hud::draw_stages(const HudValues& v) {
  const float lines = static_cast<float>(v.stages.size() + 1), height = lines * kLine + kPad;
  const float top = height_ - kMargin - 4 * kLine - kPad - 6, left = kMargin + kPad;
  plates_.add(kMargin, top - height, kStatusWidth, height, kPlate);
  float y = top - kLine + 2;
  const auto row = [&](const std::string& name, double ms, const osg::Vec4& color) {
    write(left, y, name, kFaint);
    const float bar = left + kNameWidth, share = static_cast<float>(std::min(ms / kFullBar, 1.0));
    plates_.add(bar, y, kBarWidth, 9, kGroove);
    plates_.add(bar, y, kBarWidth * share, 9, color);
    write(kMargin + kStatusWidth - kPad, y, fmt::format("{:.2f} ms", ms), kText, true);
    y -= kLine;
  };
  for (const StageMeter::Row& stage : v.stages) row(stage.name, stage.ms, kBar);
  row("drawing", v.drawing_ms, kDrawing);
}

void Hud::draw_tools(const HudValues& v) {
  std::string text = fmt::format("click: {} bomb (+ -)    b: {} (tab)", charge(v.yield), v.body);
  if (!v.followed.empty()) text += fmt::format("    following {}", v.followed);
  text += "    h: help";
  plates_.add(kMargin, kMargin, width_ - 2 * kMargin, kLine + kPad, kPlate);
  write(kMargin + kPad, kMargin + kPad, text, kText);
  write(width_ - kMargin - kPad, kMargin + kPad, v.message, kWarning, true);
}

void Hud::draw_legend(const HudValues& v) {
  if (!v.scale || v.scale->title.empty()) return;
  const ColorScale& scale = *v.scale;
  const bool named = !scale.labels.empty();
  const float left = width_ - kMargin - kLegendWidth, top = height_ - kMargin;
  const auto color = [&](std::size_t i) {
    return osg::Vec4(scale.stops[i][0], scale.stops[i][1], scale.stops[i][2], 1);
  };
  std::size_t rows = kScaleStops;
  if (named) rows = scale.labels.size();
  plates_.add(left, top - static_cast<float>(rows + 1) * kLine - kPad, kLegendWidth,
              static_cast<float>(rows + 1) * kLine + kPad, kPlate);
  float y = top - kLine + 2;
  write(left + kPad, y, scale.title, kText);
  const bool is_height = scale.title.starts_with("height");
  for (std::size_t i = 0; i < rows; ++i) {
    y -= kLine;
    // The largest number is on top, names go downward.
    const std::size_t stop = named ? i : kScaleStops - 1 - i;
    plates_.add(left + kPad, y - 4, 22, kLine, color(stop));
    const double share = static_cast<double>(stop) / (kScaleStops - 1);
    const double number = scale.low + share * (scale.high - scale.low) + (is_height ? v.height_offset : 0);
    write(left + kPad + 32, y, named ? scale.labels[i] : fmt::format("{:.4g}", number), kText);
  }
}

void Hud::draw_help() {
  std::vector<std::pair<std::string, std::string>> lines = {{"left drag", "turn"},
                                                            {"right drag", "move (or middle)"},
                                                            {"wheel", "closer, farther"},
                                                            {"left click", "bomb on the ground"}};
  for (const KeyBinding& key : key_bindings()) {
    if (!key.text.empty()) lines.emplace_back(key.name, key.text);
  }
  const float height = static_cast<float>(lines.size()) * kLine + 2 * kPad;
  const float left = std::round((width_ - kHelpWidth) / 2), top = std::round((height_ + height) / 2);
  plates_.add(left, top - height, kHelpWidth, height, kDarkPlate);
  float y = top - kPad - kSize;
  for (const auto& [name, text] : lines) {
    write(left + 2 * kPad, y, name, kWarning);
    write(left + 2 * kPad + kHelpText, y, text, kText);
    y -= kLine;
  }
}

}  // namespace divot::viewer
