#include "viewer/live_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viewer/pick.h"

namespace divot::viewer {
namespace {

constexpr double kPickReach = 1e3;    // in distances between eye and target
constexpr double kClearance = 0.03;   // of that distance, between eye and ground
constexpr double kRefocusMove = 0.2;  // of what shadows cover, that the target may move before they follow
constexpr double kRefocusZoom = 1.5;  // how much nearer or farther the eye may come before they follow
constexpr double kFocus = 0.7;        // half of what shadows cover, in distances between eye and target
constexpr int kBoxLevels = 2;         // between two sets of boxes

}  // namespace

LiveView::LiveView(LiveWorld live, const Look& look, double aspect)
    : live_(std::move(live)), look_(look), scene_({}, look), toolbox_(live_.world()) {
  const World& world = live_.world();
  start_ = focus_ = frame(world.surface(), world.bodies(), world.bombs(), aspect);
  control_ = CameraControl(start_.camera);
  scene_.set_view(world.surface().origin, start_.region, start_.camera);
}

void LiveView::carry_out(const Command& command, const WindowPoint& mouse, double aspect) {
  if (const auto* orbit = std::get_if<OrbitCommand>(&command)) control_.orbit(orbit->right, orbit->up);
  if (const auto* pan = std::get_if<PanCommand>(&command)) control_.pan(pan->right, pan->up);
  if (const auto* zoom = std::get_if<ZoomCommand>(&command)) control_.zoom(zoom->notches);
  if (const auto* bomb = std::get_if<BombCommand>(&command)) throw_at(bomb->at, aspect, true);
  if (const auto* action = std::get_if<Action>(&command)) act(*action, mouse, aspect);
}

void LiveView::act(Action action, const WindowPoint& mouse, double aspect) {
  switch (action) {
    case Action::pause:
      return live_.toggle_pause();
    case Action::step:
      return live_.step();
    case Action::restart:
      return restart();
    case Action::slow_motion:
      return live_.next_speed();
    case Action::more_yield:
      return toolbox_.change_yield(true);
    case Action::less_yield:
      return toolbox_.change_yield(false);
    case Action::drop_body:
      return throw_at(mouse, aspect, false);
    case Action::next_body:
      return toolbox_.next_body();
    case Action::follow:
      return follow_next();
    case Action::wireframe:
      look_.wireframe = !look_.wireframe;
      break;
    case Action::next_color:
      return next_color();
    case Action::particles:
      look_.particles = !look_.particles;
      break;
    case Action::boxes:
      return next_boxes();
    case Action::quality:
      return set_quality(look_.quality == Quality::fast ? Quality::fine : Quality::fast);
    default:
      return;
  }
  scene_.set_look(look_);
}

void LiveView::set_quality(Quality quality) {
  look_.quality = quality;
  scene_.set_look(look_);
  message_ = quality == Quality::fast ? "fast picture" : "fine picture";
}

void LiveView::next_color() {
  look_.color = static_cast<ColorBy>((static_cast<std::size_t>(look_.color) + 1) % kColorByNames.size());
  scene_.set_look(look_);
}

void LiveView::throw_at(const WindowPoint& at, double aspect, bool bomb) {
  const Vec3d origin = live_.world().surface().origin;
  const auto place =
      pick_ground(scene_.terrain().ground(), origin, camera(), aspect, at, kPickReach * control_.distance());
  if (!place) {
    message_ = "there is no ground";
    return;
  }
  tell(bomb ? toolbox_.bomb(live_.world(), place->x, place->y) : toolbox_.drop(live_.world(), place->x, place->y));
}

void LiveView::restart() {
  const auto restarted = live_.restart();
  tell(restarted);
  if (!restarted) return;
  followed_.reset();
  scene_.begin_another_world();
}

void LiveView::tell(const Result<void>& result) {
  if (!result) message_ = result.error().front().text();
}

void LiveView::follow_next() {
  const std::uint32_t next = followed_ ? *followed_ + 1 : 0;
  const auto bodies = live_.world().bodies();
  followed_.reset();
  if (next >= bodies.size()) return;
  followed_ = next;
  // The body comes to the middle, the distance stays.
  control_.shift(bodies[next].position - control_.camera().target);
  followed_at_ = bodies[next].position;
}

std::string LiveView::followed() const {
  if (!followed_) return {};
  const std::string name = live_.world().bodies()[*followed_].name;
  return name.empty() ? fmt::format("body {}", *followed_ + 1) : name;
}

void LiveView::next_boxes() {
  box_level_ += kBoxLevels;
  if (live_.world().bvh_boxes(box_level_).empty()) box_level_ = 0;
  message_ = box_level_ > 0 ? fmt::format("boxes of level {}", box_level_) : "no boxes";
  show_boxes();
}

void LiveView::show_boxes() {
  scene_.set_boxes(box_level_ > 0 ? live_.world().bvh_boxes(box_level_) : decltype(live_.world().bvh_boxes(0)){});
}

void LiveView::advance(double real) { live_.advance(real); }

void LiveView::update() {
  follow();
  const Camera now = camera();
  control_.keep_above(live_.world().ground_height(now.eye.x, now.eye.y), kClearance * control_.distance());
  refocus();
  const Vec3d eye = camera().eye - live_.world().surface().origin;
  scene_.set_eye({eye.x, eye.y, eye.z});
  if (box_level_ > 0) show_boxes();
  scene_.update(take_snapshot(live_.world()));
}

void LiveView::follow() {
  if (!followed_) return;
  const Vec3d now = live_.world().bodies()[*followed_].position;
  control_.shift(now - followed_at_);
  followed_at_ = now;
}

// Shadows cover what is looked at: all of the terrain where that fits, otherwise as much as the eye is away.
void LiveView::refocus() {
  const Camera now = camera();
  const double distance = control_.distance(), before = length(focus_.camera.eye - focus_.camera.target);
  const double moved = length(now.target - focus_.camera.target);
  const bool zoomed = distance > kRefocusZoom * before || before > kRefocusZoom * distance;
  if (moved < kRefocusMove * focus_.region.extent() && !zoomed) return;
  const Region& terrain = scene_.terrain().bounds();
  const double reach = kFocus * distance;
  const Vec3d half = {reach, reach, reach};
  focus_ = {.camera = now, .region = {.min = now.target - half, .max = now.target + half}};
  if (terrain.extent() < 2 * reach) focus_.region = terrain;
  scene_.set_focus(live_.world().surface().origin, focus_.region, now);
}

std::string LiveView::take_message() { return std::exchange(message_, {}); }

}  // namespace divot::viewer
