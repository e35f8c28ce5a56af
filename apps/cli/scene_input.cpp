#include "cli/scene_input.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace divot::cli {
namespace {

// --duration is an override like those of --set, but its errors are to name what was typed.
constexpr const char* kDurationSource = "--set duration";

// Errors that know of no file are about `file`.
Result<World> named(Result<World> world, const std::string& file) {
  if (world) return world;
  for (Error& error : world.error())
    if (error.file.empty()) error.file = file;
  return world;
}

}  // namespace

Result<Scene> load(const SceneOptions& options) {
  std::vector<Override> overrides = options.overrides;
  if (!options.duration.empty()) overrides.push_back({"duration", options.duration});
  auto scene = load_scene(options.path, overrides);
  if (scene || options.duration.empty()) return scene;
  Errors errors = std::move(scene.error());
  for (Error& error : errors)
    if (error.file == kDurationSource) error.file = "--duration", error.key.clear();
  return tl::unexpected(std::move(errors));
}

SceneFile scene_file(const SceneOptions& options, const std::string& replay) {
  SceneFile scene{std::filesystem::absolute(options.path).string(), options.overrides, {}};
  if (!replay.empty()) scene.replay = std::filesystem::absolute(replay).string();
  if (!options.duration.empty()) scene.overrides.push_back({"duration", options.duration});
  return scene;
}

std::string scene_text(const SceneFile& scene) {
  std::ifstream in(scene.path, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(in), {});
  for (const Override& change : scene.overrides) text += fmt::format("\n# --set {}={}", change.key, change.value);
  return text;
}

Result<World> open_world(const SceneOptions& options) {
  const auto scene = load(options);
  if (!scene) return tl::unexpected(scene.error());
  return named(World::create(*scene, std::make_shared<const Jobs>(options.threads)), options.path);
}

Result<World> reopen_world(const SceneOptions& options, const Checkpoint& checkpoint,
                           const std::string& checkpoint_file) {
  const auto scene = load(options);
  if (!scene) return tl::unexpected(scene.error());
  return named(World::restore(checkpoint.world, *scene, std::make_shared<const Jobs>(options.threads)),
               checkpoint_file);
}

std::uint64_t step_count(const Scene& scene) {
  return static_cast<std::uint64_t>(std::llround(scene.duration / scene.dt));
}

std::string results_folder(const std::string& out, const Scene& scene) {
  return out.empty() ? (std::filesystem::path("out") / scene.name).string() : out;
}

int report(const Errors& errors, int status) {
  for (const Error& error : errors) fmt::print(stderr, "{}\n", error.text());
  return status;
}

}  // namespace divot::cli
