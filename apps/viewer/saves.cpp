#include "viewer/saves.h"

#include <fmt/format.h>

#include <filesystem>

#include "divot/output.h"

namespace divot::viewer {

std::string free_path(const std::string& folder, const std::string& prefix, const std::string& suffix) {
  for (int i = 1;; ++i) {
    const auto path = std::filesystem::path(folder) / fmt::format("{}_{:03}{}", prefix, i, suffix);
    std::error_code unreadable;
    if (!std::filesystem::exists(path, unreadable)) return path.lexically_normal().string();
  }
}

Result<std::string> save_state(const World& world, const std::string& folder, double seconds) {
  const std::string name = world.scene().name.empty() ? "divot" : world.scene().name;
  const std::string path = free_path(folder, name + "_state", "");
  auto recorder = Recorder::create(path);
  if (!recorder) return tl::unexpected(recorder.error());
  recorder->add_bodies(world);
  return recorder->finish(world, {.wall_s = seconds}).map([&] { return path; });
}

}  // namespace divot::viewer
