#include <fmt/format.h>

#include "scene/fingerprint.h"
#include "world/state.h"

namespace divot {
namespace {

Result<void> done(const auto& result) {
  if (!result) return tl::unexpected(result.error());
  return {};
}

// Does what a command says to a world.
struct Doer {
  World& world;

  Result<void> operator()(const BodySettings& body) { return done(world.spawn(body)); }
  Result<void> operator()(const Joint& joint) { return done(world.add_joint(joint)); }
  Result<void> operator()(const Bomb& bomb) { return world.add_bomb(bomb); }
  Result<void> operator()(const GroundPush& push) { return world.push_ground(push); }
  Result<void> operator()(const MotorSetting& motor) {
    if (!has(motor.joint)) return no_joint(motor.joint);
    world.set_motor({motor.joint}, motor.speed, motor.force);
    return {};
  }
  Result<void> operator()(const SteeringSetting& steering) {
    if (!has(steering.joint)) return no_joint(steering.joint);
    world.set_steering({steering.joint}, steering.angle_deg);
    return {};
  }

  bool has(std::uint32_t joint) const { return joint < world.joints().size(); }
  Result<void> no_joint(std::uint32_t joint) const {
    return fail({.key = "joint",
                 .problem = fmt::format("there is no joint {}", joint),
                 .expected = fmt::format("expected less than {}", world.joints().size())});
  }
};

}  // namespace

Result<void> World::carry_out(const Command& command) { return std::visit(Doer{*this}, command.what); }

void World::keep_commands() { impl_->keeps_commands = true; }
std::span<const Command> World::commands() const { return impl_->commands; }

std::uint64_t World::scene_fingerprint() const { return scene::fingerprint(impl_->scene, impl_->materials); }

}  // namespace divot
