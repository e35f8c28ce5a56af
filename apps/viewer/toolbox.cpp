#include "viewer/toolbox.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

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

BodySettings ball(const World& world, const char* name, double radius) {
  const double gravity = length(world.scene().gravity);
  return {.name = name,
          .shape = Sphere{radius},
          .mass = sinking_mass(world.materials().front(), radius, gravity > 0 ? gravity : kStandardGravity)};
}

}  // namespace

Toolbox::Toolbox(const World& world) : bodies_(world.scene().bodies) {
  const double spacing = world.surface().spacing;
  bodies_.push_back(ball(world, "small ball", kBallSpacings * spacing));
  bodies_.push_back(ball(world, "boulder", kBoulderSpacings * spacing));
  body_ = bodies_.size() - 2;
  // As large as the scene's own bombs; otherwise a crater of a dozen cells.
  double wanted = std::pow(12 * spacing / 7.13, 3);  // eq. 10
  for (const Bomb& bomb : world.scene().bombs) wanted = bomb.yield;
  while (yield_step_ < kMostYield && tons(yield_step_) < 0.99 * wanted) ++yield_step_;
  while (yield_step_ > kLeastYield && tons(yield_step_ - 1) >= 0.99 * wanted) --yield_step_;
}

void Toolbox::change_yield(bool up) { yield_step_ = std::clamp(yield_step_ + (up ? 1 : -1), kLeastYield, kMostYield); }

double Toolbox::yield() const { return tons(yield_step_); }

void Toolbox::next_body() { body_ = (body_ + 1) % bodies_.size(); }

namespace {

// Roughly: half of what a shape measures across.
double radius_of(const Shape& shape) {
  if (const auto* s = std::get_if<Sphere>(&shape)) return s->radius;
  if (const auto* b = std::get_if<Box>(&shape)) return 0.5 * length(b->size);
  if (const auto* c = std::get_if<Cylinder>(&shape)) return std::hypot(c->radius, 0.5 * c->length);
  if (const auto* c = std::get_if<Capsule>(&shape)) return c->radius + 0.5 * c->length;
  if (const auto* c = std::get_if<Cone>(&shape)) return std::hypot(c->radius, 0.5 * c->height);
  return 1;
}

}  // namespace

std::string Toolbox::body_text() const {
  const BodySettings& body = bodies_[body_];
  return fmt::format("{}, {:.3g} m, {:.3g} kg", body.name.empty() ? "body" : body.name, 2 * radius_of(body.shape),
                     body.mass);
}

Result<void> Toolbox::bomb(World& world, double x, double y) const {
  return world.add_bomb({.time = world.time(), .position = {x, y, 0}, .above_ground = true, .yield = yield()});
}

Result<void> Toolbox::drop(World& world, double x, double y) const {
  BodySettings body = bodies_[body_];
  body.name = fmt::format("{} {}", body.name.empty() ? "body" : body.name, world.bodies().size() + 1);
  body.position = {x, y, kFall * radius_of(body.shape)};
  body.above_ground = true;
  body.velocity = body.angular_velocity = {};
  return world.spawn(body).map([](BodyId) {});
}

}  // namespace divot::viewer
