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

std::string scene_text(const SceneOptions& options) {
  std::ifstream in(options.path, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(in), {});
  for (const Override& change : options.overrides) text += fmt::format("\n# --set {}={}", change.key, change.value);
  if (!options.duration.empty()) text += fmt::format("\n# --duration {}", options.duration);
  return text;
}

Result<World> open_world(const SceneOptions& options) {
  const auto scene = load(options);
  if (!scene) return tl::unexpected(scene.error());
  auto world = World::create(*scene, std::make_shared<const Jobs>(options.threads));
  if (world) return world;
  Errors errors = std::move(world.error());
  for (Error& error : errors)
    if (error.file.empty()) error.file = options.path;
  return tl::unexpected(std::move(errors));
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
