#pragma once

namespace divot::viewer {

/// Keeps memory that is freed for the next picture. Software renderers take and free megabytes in each; handed back to
/// the system, its 400 pages would be fetched and cleared anew 60 times a second. For all of the process: programs
/// that show a window call it, libraries do not.
void keep_freed_memory();

}  // namespace divot::viewer
