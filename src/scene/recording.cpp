#include "divot/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "output/atomic_file.h"
#include "scene/bounds.h"
#include "scene/describe.h"
#include "scene/includes.h"
#include "scene/reader.h"
#include "scene/writer.h"

namespace divot {
namespace scene {
namespace {

constexpr Branch kCommands[] = {{"body", {}, "body = { shape = { sphere = { radius = 1.0 } }, ... }"},
                                {"joint", {}, "joint = { type = \"hinge\", first = \"a\", second = \"b\" }"},
                                {"bomb", {}, "bomb = { position = [0, 0], yield = 1.0 }"},
                                {"push", {}, "push = { position = [0, 0, 0], radius = 1.0, velocity = [1, 0, 0] }"},
                                {"motor", {}, "motor = { joint = 0, speed = 1.0, force = 10.0 }"},
                                {"steering", {}, "steering = { joint = 0, angle_deg = 10.0 }"}};

template <class T>
T& as(Command& command) {
  if (T* held = std::get_if<T>(&command.what)) return *held;
  return command.what.emplace<T>();
}

void describe_joint_index(Visitor& v, std::uint32_t& joint) {
  v.whole({.name = "joint", .range = between(0, 4e9), .required = true}, joint);
}

void describe(Visitor& v, GroundPush& push) {
  v.vector({.name = "position", .unit = "m", .range = between(-kFar, kFar), .required = true}, push.position);
  v.number({.name = "radius", .unit = "m", .range = above(0, kLong), .required = true}, push.radius);
  v.vector({.name = "velocity", .unit = "m/s", .range = between(-kFast, kFast), .required = true}, push.velocity);
}

void describe(Visitor& v, MotorSetting& motor) {
  describe_joint_index(v, motor.joint);
  v.number({.name = "speed", .range = between(-kFast, kFast)}, motor.speed);
  v.number({.name = "force", .range = between(0, kHeavy)}, motor.force);
}

void describe(Visitor& v, SteeringSetting& steering) {
  describe_joint_index(v, steering.joint);
  v.number({.name = "angle_deg", .unit = "degrees", .range = between(-360, 360)}, steering.angle_deg);
}

void describe(Visitor& v, Command& command) {
  v.whole({.name = "step", .range = {.low = 0}, .required = true}, command.step);
  for (const std::size_t kind : v.branches(kCommands, command.what.index())) {
    const auto table = [&](auto& what) {
      v.table({.name = kCommands[kind].name, .example = kCommands[kind].example}, [&] { describe(v, what); });
    };
    if (kind == 0) table(as<BodySettings>(command));
    if (kind == 1) table(as<Joint>(command));
    if (kind == 2) table(as<Bomb>(command));
    if (kind == 3) table(as<GroundPush>(command));
    if (kind == 4) table(as<MotorSetting>(command));
    if (kind == 5) table(as<SteeringSetting>(command));
  }
}

void describe_recording(Visitor& v, Recording& recording, std::string& fingerprint) {
  v.text({.name = "scene", .required = true}, recording.scene);
  v.text({.name = "fingerprint"}, fingerprint);
  v.whole({.name = "steps", .range = {.low = 0}, .required = true}, recording.steps);
  v.list({.name = "set"}, recording.changes, [&](Override& change) {
    v.text({.name = "key", .required = true}, change.key);
    v.text({.name = "value", .required = true}, change.value);
  });
  v.list({.name = "commands"}, recording.commands, [&](Command& command) { describe(v, command); });
}

// A hull of points that no file holds.
template <class AnyShape>
bool is_in_memory(const AnyShape& shape) {
  const Hull* hull = std::get_if<Hull>(&shape);
  return hull != nullptr && hull->file.empty();
}

bool has_hull_in_memory(const Command& command) {
  const auto* body = std::get_if<BodySettings>(&command.what);
  if (body == nullptr) return false;
  if (is_in_memory(body->shape)) return true;
  const auto* compound = std::get_if<Compound>(&body->shape);
  return compound != nullptr &&
         std::ranges::any_of(compound->parts, [](const Part& part) { return is_in_memory(part.shape); });
}

Errors contradictions(const Recording& recording) {
  const auto later = std::ranges::adjacent_find(recording.commands, std::greater<>{}, &Command::step);
  if (later == recording.commands.end()) return {};
  const auto index = later - recording.commands.begin() + 1;
  return {{.key = fmt::format("commands[{}].step", index),
           .problem = fmt::format("{} comes after {}", (later + 1)->step, later->step),
           .expected = "expected commands in the order in which they came"}};
}

}  // namespace
}  // namespace scene

Result<void> write_recording(const std::string& path, const Recording& recording) {
  if (std::ranges::any_of(recording.commands, scene::has_hull_in_memory))
    return fail({.file = path,
                 .key = "commands",
                 .problem = "a hull whose points are in memory cannot be written",
                 .expected = "hulls of files"});
  Recording copy = recording;
  std::string fingerprint = copy.fingerprint == 0 ? std::string() : fmt::format("{:016x}", copy.fingerprint);
  scene::Writer writer;
  scene::describe_recording(writer, copy, fingerprint);
  std::ostringstream text;
  text << writer.document << '\n';
  auto file = output::AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  file->write(text.str());
  return file->commit();
}

Result<Recording> read_recording(const std::string& path) {
  const auto text = scene::read_scene_file(path);
  if (!text) return tl::unexpected(text.error());
  const auto document = scene::parse_toml(*text, path);
  if (!document) return tl::unexpected(document.error());
  Recording recording;
  std::string fingerprint;
  scene::Reader reader(*document, path);
  scene::describe_recording(reader, recording, fingerprint);
  reader.finish();
  Errors wrong = scene::contradictions(recording);
  char* end = nullptr;
  recording.fingerprint = std::strtoull(fingerprint.c_str(), &end, 16);
  if (*end != '\0')
    wrong.push_back({.key = "fingerprint",
                     .problem = fmt::format("\"{}\" is no fingerprint", fingerprint),
                     .expected = "expected 16 hexadecimal digits, or none for any scene"});
  reader.add_located(wrong);
  if (Errors errors = reader.take_errors(); !errors.empty()) return tl::unexpected(std::move(errors));
  return recording;
}

}  // namespace divot
