#include "cli/series.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/interrupt.h"
#include "cli/video.h"

namespace divot::cli {
namespace {

constexpr double kUsualFps = 30;
constexpr double kRounding = 1e-9;

std::string path_of(const std::string& folder, std::size_t number) {
  return (std::filesystem::path(folder) / frame_name(number)).string();
}

}  // namespace

Result<Series> plan_series(const RenderOptions& options, const Scene& scene, const std::string& folder) {
  Series series{.fps = options.fps};
  if (series.fps == 0 && options.video.empty()) return series;
  const double steps = 1 / scene.dt;
  if (series.fps == 0) series.fps = std::min(kUsualFps, steps);
  if (!(series.fps <= steps * (1 + kRounding))) {
    return fail({.file = "--fps",
                 .problem = fmt::format("{:g} pictures a second are more than there are steps", series.fps),
                 .expected = fmt::format("expected above 0 to {:g}, or shorter steps: --set dt=...", steps)});
  }
  series.count = static_cast<std::size_t>(scene.duration * series.fps * (1 + kRounding)) + 1;
  if (options.video.empty()) return series;
  return video_path(folder, options.video).map([&](const std::string& path) {
    series.video = path;
    return series;
  });
}

Result<void> draw_series(Filming& filming, const Series& series, bool wireframe, const std::string& folder) {
  // Said before the work, which may take long.
  const bool filmed = !series.video.empty() && has_ffmpeg();
  if (!series.video.empty() && !filmed) {
    fmt::print(stderr, "{}: not made, as ffmpeg is not installed; drawing its numbered pictures\n", series.video);
  }
  for (std::size_t k = 0; k < series.count; ++k) {
    const auto image = filming.picture_at(static_cast<double>(k) / series.fps, wireframe);
    if (!image) return tl::unexpected(image.error());
    if (interrupted()) return {};
    if (const auto written = viewer::write_png(*image, path_of(folder, k + 1)); !written) return written;
  }
  filming.say(series.count == 1 ? path_of(folder, 1)
                                : fmt::format("{} to {}", path_of(folder, 1), frame_name(series.count)));
  if (!filmed) return {};
  return write_video(folder, series.count, series.fps, series.video).map([&] { filming.say(series.video); });
}

}  // namespace divot::cli
