#pragma once

#include <string>

#include "cli/options.h"
#include "divot/world.h"

namespace divot::cli {

/// A scene's file as it stands, with what the command line changes as comments below it.
std::string scene_text(const SceneOptions& options);

/// The scene of a file, changed as the command line asks. Errors name the file or the option they came from.
Result<Scene> load(const SceneOptions& options);

/// The world of a scene file, changed as the command line asks. Errors name the file or the option they came from.
Result<World> open_world(const SceneOptions& options);

/// Steps from the start to the scene's end.
std::uint64_t step_count(const Scene& scene);

/// Where results go unless the command line says otherwise: `out/NAME`.
std::string results_folder(const std::string& out, const Scene& scene);

/// Prints each error on a line of its own to stderr; returns `status`.
int report(const Errors& errors, int status);

}  // namespace divot::cli
