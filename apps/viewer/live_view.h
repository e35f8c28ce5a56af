#pragma once

#include <optional>
#include <string>

#include "viewer/camera_control.h"
#include "viewer/input.h"
#include "viewer/live_world.h"
#include "viewer/scene_graph.h"
#include "viewer/toolbox.h"

namespace divot::viewer {

/// A live world, how it is looked at, and what commands do to both. Knows nothing of windows.
class LiveView {
 public:
  /// `aspect`: width over height of what shows it.
  LiveView(LiveWorld live, const Look& look, double aspect);

  /// Actions that are the window's (quit, help, saving) are left alone. `mouse`: where it is. `aspect` as above.
  void carry_out(const Command& command, const WindowPoint& mouse, double aspect);

  /// Lets `real` seconds pass.
  void advance(double real);

  /// Brings the scene graph up to date with the world. [O(changed chunks + bodies + bombs)]
  void update();

  void set_quality(Quality quality);

  Camera camera() const { return control_.camera(); }
  const LiveWorld& live() const { return live_; }
  const Toolbox& toolbox() const { return toolbox_; }
  SceneGraph& scene() { return scene_; }
  /// Name of the body that the camera goes with; empty: none.
  std::string followed() const;

  /// What went wrong or changed since the last call, for people; empty: nothing.
  std::string take_message();

 private:
  void act(Action action, const WindowPoint& mouse, double aspect);
  void throw_at(const WindowPoint& at, double aspect, bool bomb);
  void restart();
  void follow_next();
  void next_color();
  void next_boxes();
  void show_boxes();
  void follow();
  void refocus();
  void tell(const Result<void>& result);

  LiveWorld live_;
  Look look_;
  SceneGraph scene_;
  Toolbox toolbox_;
  CameraControl control_;
  Framing start_, focus_;  // of the first picture; of what shadows and haze follow now
  std::optional<std::uint32_t> followed_;
  Vec3d followed_at_;  // m, where it was last
  int box_level_ = 0;  // 0: none shown
  std::string message_;
};

}  // namespace divot::viewer
