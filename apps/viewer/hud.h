#pragma once

#include <osg/Camera>
#include <span>
#include <string>
#include <vector>

#include "viewer/color_scale.h"
#include "viewer/overlay.h"
#include "viewer/stage_meter.h"

namespace divot::viewer {

/// What the heads-up display tells.
struct HudValues {
  double time = 0;              ///< s, simulated
  double real_time_factor = 0;  ///< simulated seconds per second
  double speed = 1;             ///< that is aimed at
  bool paused = false, lagging = false;
  double pictures_per_second = 0;
  std::size_t awake = 0;  ///< particles
  double uploaded = 0;    ///< bytes a picture
  std::span<const StageMeter::Row> stages;
  double drawing_ms = 0;  ///< a picture, without the steps
  double yield = 0;       ///< t of TNT, of the next bomb
  std::string body;       ///< that would be dropped
  std::string followed;   ///< empty: none
  std::string message;    ///< what just happened; empty: nothing
  const ColorScale* scale = nullptr;
  double height_offset = 0;  ///< m, added to labels of heights: the surface's origin
  bool help = false;
};

/// Numbers, bars and help over the picture.
class Hud {
 public:
  Hud();

  /// `width`, `height`: of the window, pixels.
  void resize(int width, int height);

  /// Call once for each picture; numbers are renewed five times a second, `now` in s.
  void update(const HudValues& values, double now);

  osg::Camera& root() { return *overlay_; }

 private:
  // A line of text at x, y; labels are reused from picture to picture.
  void write(float x, float y, const std::string& content, const osg::Vec4& color, bool right_aligned = false);
  void draw_status(const HudValues& values);
  void draw_stages(const HudValues& values);
  void draw_tools(const HudValues& values);
  void draw_legend(const HudValues& values);
  void draw_help();

  osg::ref_ptr<osg::Camera> overlay_;
  Plates plates_;
  std::vector<osg::ref_ptr<osgText::Text>> labels_;
  std::size_t used_labels_ = 0;
  float width_ = 1, height_ = 1;
  double next_renewal_ = 0;
  bool help_ = false;
  std::string message_;
};

}  // namespace divot::viewer
