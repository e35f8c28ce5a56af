#pragma once

#include <string>

#include "cli/options.h"
#include "divot/output.h"
#include "divot/world.h"

namespace divot::cli {

/// The scene's file, all that the command line changes and the recording carried out on it, by absolute paths.
SceneFile scene_file(const SceneOptions& options, const std::string& replay = {});

/// A scene's file as it stands, with what changes it as comments below it.
std::string scene_text(const SceneFile& scene);

/// The scene of a file, changed as the command line asks. Errors name the file or the option they came from.
Result<Scene> load(const SceneOptions& options);

/// The world of a scene file, changed as the command line asks. Errors name the file or the option they came from.
Result<World> open_world(const SceneOptions& options);

/// The same world where a run of it was put aside. Errors of the bytes name `checkpoint_file`.
Result<World> reopen_world(const SceneOptions& options, const Checkpoint& checkpoint,
                           const std::string& checkpoint_file);

/// Steps from the start to the scene's end.
std::uint64_t step_count(const Scene& scene);

/// Where results go unless the command line says otherwise: `out/NAME`.
std::string results_folder(const std::string& out, const Scene& scene);

/// Prints each error on a line of its own to stderr; returns `status`.
int report(const Errors& errors, int status);

}  // namespace divot::cli
