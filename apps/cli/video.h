#pragma once

#include <cstddef>
#include <string>

#include "divot/errors.h"

namespace divot::cli {

/// Name of the picture `number` (from 1) of a series.
std::string frame_name(std::size_t number);

/// Where the video `name` goes when pictures go to `folder`. Fails when that is outside of the folder, or when the
/// name's ending is none that a video can have.
Result<std::string> video_path(const std::string& folder, const std::string& name);

/// Whether there is an ffmpeg to make videos with.
bool has_ffmpeg();

/// Makes a video of the first `count` pictures of the series in `folder`, `fps` a second. It appears whole or not at
/// all. Fails with what ffmpeg says.
Result<void> write_video(const std::string& folder, std::size_t count, double fps, const std::string& path);

}  // namespace divot::cli
