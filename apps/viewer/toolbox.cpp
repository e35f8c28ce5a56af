#include "viewer/toolbox.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "viewer/failure.h"

namespace divot::viewer {
namespace {

constexpr int kLeastYield = -3, kMostYield = 15;             // steps: 0.1 t, 100 kt
constexpr double kBallSpacings = 1.5, kBoulderSpacings = 4;  // radius in grid spacings
constexpr double kGive = 0.2;                                // of its radius that a ball's own weight presses it in
constexpr double kFall = 1.5, kJoinedFall = 0.3;             // radii above the ground from which bodies are dropped
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

bool joins_bodies(const Joint& joint) { return !joint.first.empty() && !joint.second.empty(); }

// The names of all bodies that joints hold to one, and its own.
std::set<std::string> joined_with(const BodySettings& body, const std::vector<Joint>& joints) {
  std::set<std::string> names = {body.name};
  for (std::size_t before = 0; before != names.size();) {
    before = names.size();
    for (const Joint& joint : joints) {
      if (!joins_bodies(joint) || names.count(joint.first) == names.count(joint.second)) continue;
      names.insert(joint.first);
      names.insert(joint.second);
    }
  }
  return names;
}

std::string numbered(const std::string& name, std::size_t number) {
  return fmt::format("{} {}", name.empty() ? "body" : name, number);
}

}  // namespace

Toolbox::Toolbox(const World& world) {
  std::vector<bool> taken(world.scene().bodies.size());
  for (std::size_t i = 0; i < taken.size(); ++i) {
    if (!taken[i]) tools_.push_back(take_assembly(world, taken, i));
  }
  tool_ = tools_.size();
  const double spacing = world.surface().spacing;
  for (const auto& [name, spacings] : {std::pair("small ball", kBallSpacings), {"boulder", kBoulderSpacings}}) {
    const double radius = spacings * spacing;
    tools_.push_back({.bodies = {{.name = name, .shape = Sphere{radius}}}, .radii = {radius}, .weighed = true});
  }
  // As large as the scene's own bombs; otherwise a crater of a dozen cells.
  double wanted = std::pow(12 * spacing / 7.13, 3);  // eq. 10
  for (const Bomb& bomb : world.scene().bombs) wanted = bomb.yield;
  while (yield_step_ < kMostYield && tons(yield_step_) < 0.99 * wanted) ++yield_step_;
  while (yield_step_ > kLeastYield && tons(yield_step_ - 1) >= 0.99 * wanted) --yield_step_;
}

Toolbox::Tool Toolbox::take_assembly(const World& world, std::vector<bool>& taken, std::size_t first) {
  const auto& bodies = world.scene().bodies;
  const std::vector<BodyView> views = world.bodies();
  const std::set<std::string> names = joined_with(bodies[first], world.scene().joints);
  Tool tool;
  for (std::size_t i = first; i < bodies.size(); ++i) {
    if (i != first && (bodies[i].name.empty() || !names.contains(bodies[i].name))) continue;
    taken[i] = true;
    BodySettings& body = tool.bodies.emplace_back(bodies[i]);
    body.position = views[i].position - views[first].position;
    body.above_ground = false;
    body.assembly.clear();
    body.velocity = body.angular_velocity = {};
    tool.radii.push_back(views[i].radius);
  }
  for (const Joint& joint : world.scene().joints) {
    if (joins_bodies(joint) && names.contains(joint.first)) tool.joints.push_back(joint);
  }
  return tool;
}

void Toolbox::change_yield(bool up) { yield_step_ = std::clamp(yield_step_ + (up ? 1 : -1), kLeastYield, kMostYield); }

double Toolbox::yield() const { return tons(yield_step_); }

void Toolbox::next_body() { tool_ = (tool_ + 1) % tools_.size(); }

std::string Toolbox::body_text() const {
  const Tool& tool = tools_[tool_];
  const BodySettings& first = tool.bodies.front();
  double mass = 0;
  for (const BodySettings& body : tool.bodies) mass += body.mass;
  std::string text = first.name.empty() ? "body" : first.name;
  if (tool.bodies.size() > 1) text += fmt::format(" and {} joined to it", tool.bodies.size() - 1);
  text += fmt::format(", {:.3g} m", 2 * tool.radii.front());
  if (tool.weighed) return text + ", as heavy as its soil just carries";
  return mass < 100 ? fmt::format("{}, {:.3g} kg", text, mass) : fmt::format("{}, {:.0f} kg", text, mass);
}

Result<void> Toolbox::bomb(World& world, double x, double y) const {
  return world.add_bomb({.time = world.time(), .position = {x, y, 0}, .above_ground = true, .yield = yield()});
}

Result<void> Toolbox::drop(World& world, double x, double y) const {
  Tool tool = tools_[tool_];
  if (tool.weighed) {
    const double gravity = length(world.scene().gravity);
    tool.bodies.front().mass =
        sinking_mass(soil_at(world, x, y), tool.radii.front(), gravity > 0 ? gravity : kStandardGravity);
  }
  // So high that the balls that hold its bodies are free of the ground.
  std::optional<double> height;
  for (std::size_t i = 0; i < tool.bodies.size(); ++i) {
    const Vec3d& place = tool.bodies[i].position;
    const double free = world.ground_height(x + place.x, y + place.y) + tool.radii[i] - place.z;
    if (std::isfinite(free)) height = std::max(height.value_or(free), free);
  }
  if (!height)
    return failure(fmt::format("there is no ground at ({:g}, {:g})", x, y), "a place on the terrain", "drop");
  const double fall = (tool.bodies.size() > 1 ? kJoinedFall : kFall) * tool.radii.front();
  return drop_bodies(world, tool, {x, y, *height + fall});
}

// Under names of their own, as joints go by names.
Result<void> Toolbox::drop_bodies(World& world, const Tool& tool, const Vec3d& at) {
  const std::size_t number = world.bodies().size() + 1;
  for (BodySettings body : tool.bodies) {
    body.name = numbered(body.name, number);
    body.position += at;
    if (const auto spawned = world.spawn(body); !spawned) return tl::unexpected(spawned.error());
  }
  for (Joint joint : tool.joints) {
    joint.first = numbered(joint.first, number);
    joint.second = numbered(joint.second, number);
    if (const auto joined = world.add_joint(joint); !joined) return tl::unexpected(joined.error());
  }
  return {};
}

}  // namespace divot::viewer
