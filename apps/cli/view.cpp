#include <optional>

#include "cli/commands.h"
#include "cli/scene_input.h"
#include "divot/recording.h"
#include "viewer/heap.h"
#include "viewer/window.h"

namespace divot::cli {
namespace {

std::optional<viewer::Quality> quality_of(const std::string& name) {
  if (name == "fast") return viewer::Quality::fast;
  if (name == "fine") return viewer::Quality::fine;
  return {};
}

// Nothing to open a window on is bad usage: pictures would have been possible.
int exit_status(const Errors& errors) {
  const std::string& key = errors.front().key;
  return key == "display" || key == "size" || key.starts_with("materials.") ? kBadInput : kFailed;
}

// Draws pictures until the window is closed. What is done in it is on disk at once, so that nothing that ends it loses
// the session.
Result<void> run_recorded(viewer::Window& window, const SceneOptions& options, const std::string& path) {
  const SceneFile scene = scene_file(options);
  Recording session{.scene = scene.path, .changes = scene.overrides};
  const auto write = [&] {
    session.fingerprint = window.world().scene_fingerprint();
    session.steps = window.world().steps();
    session.commands.assign(window.world().commands().begin(), window.world().commands().end());
    return write_recording(path, session);
  };
  if (auto written = write(); !written) return written;
  while (window.frame()) {
    if (window.world().commands().size() == session.commands.size()) continue;
    if (auto written = write(); !written) return written;
  }
  return write();
}

}  // namespace

int view(const ViewOptions& options) {
  const auto scene = load(options.scene);
  if (!scene) return report(scene.error(), kBadInput);
  viewer::keep_freed_memory();
  auto window = viewer::Window::create(
      *scene, std::make_shared<const Jobs>(options.scene.threads),
      {.width = options.width, .height = options.height, .quality = quality_of(options.quality)});
  if (!window) {
    for (Error& error : window.error())
      if (error.key.starts_with("materials.")) error.file = options.scene.path;
    return report(window.error(), exit_status(window.error()));
  }
  if (options.record.empty()) {
    window->run();
    return kDone;
  }
  const auto recorded = run_recorded(*window, options.scene, options.record);
  return recorded ? kDone : report(recorded.error(), kFailed);
}

}  // namespace divot::cli
