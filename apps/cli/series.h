#pragma once

#include <cstddef>
#include <string>

#include "cli/filming.h"
#include "cli/options.h"

namespace divot::cli {

/// A picture series over a whole run.
struct Series {
  double fps = 0;         ///< pictures a second; 0: no series is asked for
  std::size_t count = 0;  ///< pictures, the first at 0 s
  std::string video;      ///< path; empty: none
};

/// The series asked for. Fails when there are more pictures a second than steps, or when the video's place is wrong.
Result<Series> plan_series(const RenderOptions& options, const Scene& scene, const std::string& folder);

/// Draws a series into `folder`, and its video; where there is no ffmpeg, stderr says so and the pictures are all there
/// is. Stops early, without a video, when interrupted(). Fails when a file cannot be written.
Result<void> draw_series(Filming& filming, const Series& series, bool wireframe, const std::string& folder);

}  // namespace divot::cli
