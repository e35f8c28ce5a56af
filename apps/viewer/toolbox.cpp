#include "viewer/toolbox.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace divot::viewer {
namespace {

constexpr int kLeastYield = -3, kMostYield = 15;             // steps: 0.1 t, 100 kt
constexpr double kBallSpacings = 1.5, kBoulderSpacings = 4;  // radius in grid spacings
constexpr double kGive = 0.2;                                // of its radius that a ball's own weight presses it in
constexpr double kFall = 1.5;                                // radii above the ground from which bodies are dropped
constexpr double kStandardGravity = 9.81;                    // m/s^2, where the scene has none

double tons(int step) {
  const int power = static_cast<int>(std::floor(step / 3.0));
  return std::array{1.0, 2.0, 5.0}[static_cast<std::size_t>(step - 3 * power)] * std::pow(10.0, power);
}

// The mass at which Bekker's pressure at that depth, over the circle that touches, carries the ball.
double sinking_mass(const Material& soil, double radius, double gravity) {
  const double depth = kGive * radius, touching = radius * std::sqrt(kGive * (2 - kGive));
  const double pressure = (soil.bekker_kc / touching + soil.bekker_kphi) * std::pow(depth, soil.bekker_n);
  return pressure * std::numbers::pi * touching * touching / gravity;
}

// What the ground is made of at x, y: of the nearest vertex.
const Material& soil_at(const World& world, double x, double y) {
  const SurfaceView surface = world.surface();
  const auto away = [&](const Vec3& p) { return std::hypot(p.x + surface.origin.x - x, p.y + surface.origin.y - y); };
  const auto nearest = std::min_element(surface.positions.begin(), surface.positions.end(),
                                        [&](const Vec3& a, const Vec3& b) { return away(a) < away(b); });
  return world.materials()[surface.materials[static_cast<std::size_t>(nearest - surface.positions.begin())]];
}

}  // namespace

Toolbox::Toolbox(const World& world) {
  const auto& bodies = world.scene().bodies;
  const std::vector<BodyView> views = world.bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i) tools_.push_back({.body = bodies[i], .radius = views[i].radius});
  tool_ = tools_.size();
  const double spacing = world.surface().spacing;
  for (const auto& [name, spacings] : {std::pair("small ball", kBallSpacings), {"boulder", kBoulderSpacings}}) {
    const double radius = spacings * spacing;
    tools_.push_back({.body = {.name = name, .shape = Sphere{radius}}, .radius = radius, .weighed = true});
  }
  // As large as the scene's own bombs; otherwise a crater of a dozen cells.
  double wanted = std::pow(12 * spacing / 7.13, 3);  // eq. 10
  for (const Bomb& bomb : world.scene().bombs) wanted = bomb.yield;
  while (yield_step_ < kMostYield && tons(yield_step_) < 0.99 * wanted) ++yield_step_;
  while (yield_step_ > kLeastYield && tons(yield_step_ - 1) >= 0.99 * wanted) --yield_step_;
}

void Toolbox::change_yield(bool up) { yield_step_ = std::clamp(yield_step_ + (up ? 1 : -1), kLeastYield, kMostYield); }

double Toolbox::yield() const { return tons(yield_step_); }

void Toolbox::next_body() { tool_ = (tool_ + 1) % tools_.size(); }

std::string Toolbox::body_text() const {
  const Tool& tool = tools_[tool_];
  const std::string text =
      fmt::format("{}, {:.3g} m", tool.body.name.empty() ? "body" : tool.body.name, 2 * tool.radius);
  return tool.weighed ? text + ", as heavy as its soil just carries"
                      : fmt::format("{}, {:.3g} kg", text, tool.body.mass);
}

Result<void> Toolbox::bomb(World& world, double x, double y) const {
  return world.add_bomb({.time = world.time(), .position = {x, y, 0}, .above_ground = true, .yield = yield()});
}

Result<void> Toolbox::drop(World& world, double x, double y) const {
  const Tool& tool = tools_[tool_];
  BodySettings body = tool.body;
  if (tool.weighed) {
    const double gravity = length(world.scene().gravity);
    body.mass = sinking_mass(soil_at(world, x, y), tool.radius, gravity > 0 ? gravity : kStandardGravity);
  }
  body.name = fmt::format("{} {}", body.name.empty() ? "body" : body.name, world.bodies().size() + 1);
  body.position = {x, y, kFall * tool.radius};
  body.above_ground = true;
  body.assembly.clear();
  body.velocity = body.angular_velocity = {};
  return world.spawn(body).map([](BodyId) {});
}

}  // namespace divot::viewer
