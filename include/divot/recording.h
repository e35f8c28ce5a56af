#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "divot/scene.h"

namespace divot {

/// A shove, as of a shock through the ground or of something that no body stands for. Ground within `radius` gets a
/// velocity: all of it in the middle, falling with (1 - (r/radius)^2)^2 to none at the edge.
struct GroundPush {
  Vec3d position;     ///< m, in the terrain's coordinates; the height does not matter
  double radius = 1;  ///< m, > 0, horizontal
  Vec3d velocity;     ///< m/s
};

/// World::set_motor as a command.
struct MotorSetting {
  std::uint32_t joint = 0;  ///< place in World::joints()
  double speed = 0;         ///< m/s or rad/s
  double force = 0;         ///< N or N m
};

/// World::set_steering as a command.
struct SteeringSetting {
  std::uint32_t joint = 0;  ///< place in World::joints()
  double angle_deg = 0;     ///< degrees
};

/// What was done to a world from outside, and when.
struct Command {
  std::uint64_t step = 0;  ///< World::steps() when it came
  std::variant<BodySettings, Joint, Bomb, GroundPush, MotorSetting, SteeringSetting> what;  ///< what came
};

/// A live session: carried out again on the same scene, its commands give the same bits.
struct Recording {
  std::string scene;              ///< the scene's file
  std::vector<Override> changes;  ///< of the scene, in order
  std::uint64_t fingerprint = 0;  ///< World::scene_fingerprint(); 0: of any scene
  std::uint64_t steps = 0;        ///< how long it lasted
  std::vector<Command> commands;  ///< in order
};

/// Writes a recording as TOML, under its name when it is complete or not at all. Fails with the system's reason, and
/// on hulls that have points in memory instead of a file.
Result<void> write_recording(const std::string& path, const Recording& recording);

/// Reads one. Errors name file, line and key.
Result<Recording> read_recording(const std::string& path);

}  // namespace divot
