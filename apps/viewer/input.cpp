#include "viewer/input.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace divot::viewer {
namespace {

using Event = osgGA::GUIEventAdapter;

constexpr float kStillPixels = 4;  // a hand that clicks moves the mouse this far

constexpr std::array kBindings = {
    KeyBinding{'p', Action::pause, "p, space", "pause"},
    KeyBinding{' ', Action::pause, "", ""},
    KeyBinding{'s', Action::step, "s, right", "single step"},
    KeyBinding{Event::KEY_Right, Action::step, "", ""},
    KeyBinding{'r', Action::restart, "r", "restart"},
    KeyBinding{'m', Action::slow_motion, "m", "slow motion: 1, 1/4, 1/16"},
    KeyBinding{'+', Action::more_yield, "+ -", "yield of the next bomb"},
    KeyBinding{'=', Action::more_yield, "", ""},
    KeyBinding{Event::KEY_KP_Add, Action::more_yield, "", ""},
    KeyBinding{'-', Action::less_yield, "", ""},
    KeyBinding{Event::KEY_KP_Subtract, Action::less_yield, "", ""},
    KeyBinding{'b', Action::drop_body, "b", "drop the chosen body at the mouse"},
    KeyBinding{Event::KEY_Tab, Action::next_body, "tab", "choose another body"},
    KeyBinding{'f', Action::follow, "f", "follow the next body, or none"},
    KeyBinding{'w', Action::wireframe, "w", "wireframe"},
    KeyBinding{'c', Action::next_color, "c", "colours: natural, height, sinkage, slope, awake, material"},
    KeyBinding{'o', Action::particles, "o", "show particles"},
    KeyBinding{'v', Action::boxes, "v", "show the hierarchy's boxes, level by level"},
    KeyBinding{'g', Action::quality, "g", "fast or fine picture"},
    KeyBinding{'x', Action::screenshot, "x, F2", "save a picture"},
    KeyBinding{Event::KEY_F2, Action::screenshot, "", ""},
    KeyBinding{'k', Action::save_state, "k", "save ground, bodies and summary"},
    KeyBinding{'h', Action::help, "h, F1", "this help"},
    KeyBinding{Event::KEY_F1, Action::help, "", ""},
    KeyBinding{'q', Action::quit, "q, Esc", "quit"},
    KeyBinding{Event::KEY_Escape, Action::quit, "", ""},
};

}  // namespace

std::span<const KeyBinding> key_bindings() { return kBindings; }

bool Input::handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter&) {
  mouse_ = {event.getXnormalized(), event.getYnormalized()};
  switch (event.getEventType()) {
    case Event::PUSH:
      button_ = event.getButton();
      dragged_ = false;
      pressed_x_ = last_x_ = event.getX();
      pressed_y_ = last_y_ = event.getY();
      return true;
    case Event::DRAG:
      move(event);
      return true;
    case Event::RELEASE:
      if (button_ == Event::LEFT_MOUSE_BUTTON && !dragged_) commands_.push_back(BombCommand{mouse_});
      button_ = 0;
      return true;
    case Event::SCROLL:
      if (event.getScrollingMotion() == Event::SCROLL_UP) commands_.push_back(ZoomCommand{1});
      if (event.getScrollingMotion() == Event::SCROLL_DOWN) commands_.push_back(ZoomCommand{-1});
      return true;
    case Event::KEYDOWN:
      // As typed, so that + is + on every keyboard; letters also with shift or caps lock.
      press_key(event.getKey() == '+' ? '+' : event.getUnmodifiedKey());
      return true;
    default:
      return false;
  }
}

void Input::move(const osgGA::GUIEventAdapter& event) {
  const float x = event.getX(), y = event.getY();
  if (std::hypot(x - pressed_x_, y - pressed_y_) > kStillPixels) dragged_ = true;
  if (!dragged_) return;
  const double height = std::max(event.getWindowHeight(), 1);
  const double upward = event.getMouseYOrientation() == Event::Y_INCREASING_DOWNWARDS ? -1 : 1;
  const double right = (x - last_x_) / height, up = upward * (y - last_y_) / height;
  last_x_ = x;
  last_y_ = y;
  if (button_ == Event::LEFT_MOUSE_BUTTON) {
    commands_.push_back(OrbitCommand{right, up});
  } else {
    commands_.push_back(PanCommand{right, up});
  }
}

void Input::press_key(int key) {
  for (const KeyBinding& binding : kBindings) {
    if (binding.key == key) return commands_.push_back(binding.action);
  }
}

std::vector<Command> Input::take() { return std::exchange(commands_, {}); }

}  // namespace divot::viewer
