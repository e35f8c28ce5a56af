#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/scene_input.h"
#include "output/atomic_file.h"
#include "viewer/renderer.h"

namespace divot::cli {
namespace {

constexpr int kUsualPictures = 5, kSheetColumns = 2;

// The times asked for, ascending, each once.
Result<std::vector<double>> picture_times(const RenderOptions& options, const Scene& scene) {
  std::vector<double> times = options.at;
  if (times.empty())
    for (int k = 0; k < kUsualPictures; ++k) times.push_back(scene.duration * k / (kUsualPictures - 1));
  for (const double time : times) {
    if (time >= 0 && time <= scene.duration) continue;
    Error error{.file = "--at"};
    error.problem = fmt::format("{:g} s is not within the run", time);
    error.expected = fmt::format("expected 0 to {:g} s, or a longer run: --set duration=...", scene.duration);
    return fail(std::move(error));
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

// A world that is drawn where it is.
class Filming {
 public:
  Filming(World& world, viewer::Renderer& renderer, std::string folder)
      : world_(world), renderer_(renderer), folder_(std::move(folder)), progress_(world.scene().duration, true) {}

  Result<void> picture_at(double time);
  Result<void> write_sheet() const;

 private:
  std::string path(const std::string& name) const {
    return (std::filesystem::path(folder_) / fmt::format("{}_{}.png", world_.scene().name, name)).string();
  }

  World& world_;
  viewer::Renderer& renderer_;
  std::string folder_;
  Progress progress_;
  std::vector<viewer::Image> images_;
};

Result<void> Filming::picture_at(double time) {
  for (const double early = time - 0.5 * world_.scene().dt; world_.time() < early && !interrupted();) {
    world_.step();
    progress_.update(world_.time());
  }
  if (interrupted()) return {};
  const std::vector<DirtyRange> dirty = world_.take_dirty();
  renderer_.update(
      world_.surface(), dirty, world_.bodies(), world_.bombs(),
      [&](std::uint32_t vertex) { return world_.sinkage(vertex); }, world_.time());
  auto image = renderer_.pixels();
  if (!image) return tl::unexpected(image.error());
  images_.push_back(std::move(*image));
  const std::string file = path(fmt::format("t{:08.3f}", time));
  if (const auto written = viewer::write_png(images_.back(), file); !written) return written;
  progress_.clear();
  fmt::print("{}\n", file);
  return {};
}

Result<void> Filming::write_sheet() const {
  const std::string file = path("sheet");
  if (const auto written = viewer::write_contact_sheet(images_, {.columns = kSheetColumns}, file); !written)
    return written;
  fmt::print("{}\n", file);
  return {};
}

}  // namespace

int render(const RenderOptions& options) {
  auto world = open_world(options.scene);
  if (!world) return report(world.error(), kBadInput);
  catch_interrupts();
  const auto times = picture_times(options, world->scene());
  if (!times) return report(times.error(), kBadInput);
  auto renderer = viewer::Renderer::create(
      {.width = options.width, .height = options.height, .wireframe = options.wireframe, .show_time = options.sheet});
  if (!renderer) return report(renderer.error(), renderer.error().front().key == "size" ? kBadInput : kFailed);
  const std::string folder = results_folder(options.out, world->scene());
  if (const auto made = output::make_folder(folder); !made) return report(made.error(), kFailed);

  Filming filming(*world, *renderer, folder);
  for (const double time : *times)
    if (const auto drawn = filming.picture_at(time); !drawn) return report(drawn.error(), kFailed);
  if (interrupted()) {
    fmt::print(stderr, "interrupted at {:.2f} s\n", world->time());
    return kFailed;
  }
  if (!options.sheet) return kDone;
  const auto written = filming.write_sheet();
  return written ? kDone : report(written.error(), kFailed);
}

}  // namespace divot::cli
