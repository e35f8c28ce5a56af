#include <optional>

#include "cli/commands.h"
#include "cli/scene_input.h"
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
  window->run();
  return kDone;
}

}  // namespace divot::cli
