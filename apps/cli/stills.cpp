#include "cli/stills.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cli/interrupt.h"
#include "viewer/shrink.h"

namespace divot::cli {
namespace {

constexpr int kUsualPictures = 5;
constexpr int kWidestSheet = 4096;  // pixels
constexpr int kMostInARow = 3;      // of pictures that fit into one row

tl::unexpected<Errors> refusal(const char* option, std::string problem, std::string expected) {
  return fail({.file = option, .problem = std::move(problem), .expected = std::move(expected)});
}

std::vector<double> usual_times(const Scene& scene) {
  std::vector<double> times;
  for (int k = 0; k < kUsualPictures; ++k) times.push_back(scene.duration * k / (kUsualPictures - 1));
  return times;
}

Result<void> check(const std::vector<double>& times, const Scene& scene) {
  for (const double time : times) {
    if (time >= 0 && time <= scene.duration) continue;
    return refusal("--at", fmt::format("{:g} s is not within the run", time),
                   fmt::format("expected 0 to {:g} s, or a longer run: --set duration=...", scene.duration));
  }
  return {};
}

// As many rows as columns, where they are more than a few.
int columns_of(std::size_t pictures) {
  const auto count = static_cast<int>(pictures);
  return count <= kMostInARow ? count : static_cast<int>(std::ceil(std::sqrt(count)));
}

// The widest that a picture can be for all to fit on the sheet.
int cell_width(const viewer::SheetLayout& layout) {
  return std::max(1, (kWidestSheet - layout.margin) / layout.columns - layout.margin);
}

}  // namespace

Result<std::vector<Shot>> plan_stills(const RenderOptions& options, const Scene& scene) {
  std::vector<double> times = options.at.empty() ? usual_times(scene) : options.at;
  if (const auto right = check(times, scene); !right) return tl::unexpected(right.error());
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());

  std::vector<Shot> shots;
  for (const double time : times) shots.push_back({.time = time, .wireframe = options.wireframe});
  for (const double time : options.wireframe_at) {
    const auto shot = std::find(times.begin(), times.end(), time);
    if (shot == times.end()) {
      return refusal("--wireframe-at", fmt::format("there is no picture at {:g} s", time),
                     fmt::format("expected some of {:g}", fmt::join(times, ", ")));
    }
    shots[static_cast<std::size_t>(shot - times.begin())].wireframe = true;
  }
  return shots;
}

Result<void> draw_stills(Filming& filming, const std::vector<Shot>& shots, bool sheet, const std::string& folder,
                         const std::string& name) {
  const auto path = [&](const std::string& what) {
    return (std::filesystem::path(folder) / fmt::format("{}_{}.png", name, what)).string();
  };
  const viewer::SheetLayout layout{.columns = columns_of(shots.size())};
  std::vector<viewer::Image> small;
  for (const Shot& shot : shots) {
    const auto image = filming.picture_at(shot.time, shot.wireframe);
    if (!image) return tl::unexpected(image.error());
    if (interrupted()) return {};
    const std::string file = path(fmt::format("t{:08.3f}", shot.time));
    if (const auto written = viewer::write_png(*image, file); !written) return written;
    filming.say(file);
    if (sheet) small.push_back(viewer::shrink(*image, cell_width(layout)));
  }
  if (!sheet) return {};
  return viewer::write_contact_sheet(small, layout, path("sheet")).map([&] { filming.say(path("sheet")); });
}

}  // namespace divot::cli
