#pragma once

#include <osgGA/GUIEventHandler>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

namespace divot::viewer {

/// What a key asks for.
enum class Action : std::uint8_t {
  pause,
  step,
  restart,
  slow_motion,
  more_yield,
  less_yield,
  drop_body,
  next_body,
  follow,
  wireframe,
  next_color,
  particles,
  boxes,
  quality,
  screenshot,
  save_state,
  help,
  quit
};

/// A place in the window: x from -1 to 1 rightward, y from -1 to 1 upward.
struct WindowPoint {
  double x = 0, y = 0;
};

// What mouse and keyboard ask for. Distances are in heights of the window, rightward and upward.
struct OrbitCommand {
  double right, up;
};
struct PanCommand {
  double right, up;
};
struct ZoomCommand {
  double notches;
};
struct BombCommand {
  WindowPoint at;
};
using Command = std::variant<OrbitCommand, PanCommand, ZoomCommand, BombCommand, Action>;

/// A key, what it does, and how the help calls both.
struct KeyBinding {
  int key;  ///< of osgGA::GUIEventAdapter
  Action action;
  std::string_view name;
  std::string_view text;  ///< empty: another key for the action before
};

/// All keys, in the order of the help.
std::span<const KeyBinding> key_bindings();

/// Turns events of a window into commands. A left click that does not move is a bomb, one that does is an orbit.
class Input : public osgGA::GUIEventHandler {
 public:
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) override;

  /// What was asked for since the last call, in order.
  std::vector<Command> take();

  WindowPoint mouse() const { return mouse_; }

 private:
  void move(const osgGA::GUIEventAdapter& event);
  void press_key(int key);

  std::vector<Command> commands_;
  WindowPoint mouse_;
  float pressed_x_ = 0, pressed_y_ = 0, last_x_ = 0, last_y_ = 0;  // pixels
  int button_ = 0;                                                 // that is held, of osgGA::GUIEventAdapter; 0: none
  bool dragged_ = false;
};

}  // namespace divot::viewer
