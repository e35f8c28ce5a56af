#include "bench/view.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <thread>

#include "bench/view_scenes.h"
#include "viewer/heap.h"
#include "viewer/window.h"

namespace divot::bench {
namespace {

constexpr int kWidth = 1280, kHeight = 720;
constexpr int kWarmUp = 10;            // pictures, until programs are compiled
constexpr double kPicture = 1.0 / 60;  // s that pass from one to the next
constexpr int kBombEvery = 150;        // pictures

struct Shown {
  const char* name;
  const char* title;
  int pictures;
  double wanted;  // pictures a second
  std::vector<viewer::FrameCost> costs = {};
  double cpu_ms = 0;  // of all threads, a picture
};

// Processor time of all threads of this program, ms.
double cpu_ms() {
  rusage use = {};
  getrusage(RUSAGE_SELF, &use);
  const auto ms = [](const timeval& t) {
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_usec);
  };
  return ms(use.ru_utime) + ms(use.ru_stime);
}

template <class Part>
double quantile(const std::vector<viewer::FrameCost>& costs, double share, Part part) {
  std::vector<double> values;
  for (const viewer::FrameCost& cost : costs) values.push_back(part(cost));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double median_ms(const Shown& shown) {
  return quantile(shown.costs, 0.5, [](const viewer::FrameCost& c) { return c.all_ms(); });
}

Result<void> run(const Scene& scene, Shown& shown) {
  auto window =
      viewer::Window::create_offscreen(scene, std::make_shared<const Jobs>(1), {.width = kWidth, .height = kHeight});
  if (!window) return tl::unexpected(window.error());
  for (int i = 0; i < kWarmUp; ++i) window->frame_after(kPicture);
  const double before = cpu_ms();
  for (int i = 0; i < shown.pictures; ++i) {
    // Ground that moves, dust that flies.
    if (i % kBombEvery == 0) window->click(0.3, 0.1 * (i / kBombEvery) - 0.2);
    shown.costs.push_back(window->frame_after(kPicture));
  }
  shown.cpu_ms = (cpu_ms() - before) / shown.pictures;
  return {};
}

std::string row(const Shown& shown) {
  const auto part = [&](double viewer::FrameCost::*member) {
    return quantile(shown.costs, 0.5, [&](const viewer::FrameCost& c) { return c.*member; });
  };
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  const double worst = quantile(shown.costs, 0.95, [](const viewer::FrameCost& c) { return c.all_ms(); });
  return fmt::format("{:<26}{:>9.1f}{:>9.1f}{:>9.1f}{:>10.1f}{:>8.2f}{:>9.2f}{:>8.2f}{:>8.2f}{:>8.2f}{:>9.0f}\n",
                     shown.title, 1e3 / median_ms(shown), median_ms(shown), worst, shown.cpu_ms / cores,
                     part(&viewer::FrameCost::step_ms), part(&viewer::FrameCost::update_ms),
                     part(&viewer::FrameCost::hud_ms), part(&viewer::FrameCost::draw_ms),
                     part(&viewer::FrameCost::share), shown.wanted);
}

}  // namespace

Result<Report> view(const Request& request) {
  std::vector<Shown> all = {{"paper", "the paper's scene", 300, 60}, {"rolling", "500000 triangles", 90, 10}};
  constexpr Result<Scene> (*kScenes[])(const std::string&) = {&paper_scene, &rolling_scene};
  viewer::keep_freed_memory();
  Report report;
  report.text = fmt::format(
      "view: the window at {} x {} without a display, a bomb every {} pictures; medians, ms; \"cpu\" is processor "
      "time a picture over {} cores, \"share\" of the pixels each way that the ground was drawn "
      "with\n{:<26}{:>9}{:>9}{:>9}{:>10}{:>8}{:>9}{:>8}{:>8}{:>8}{:>9}\n",
      kWidth, kHeight, kBombEvery, std::max(1u, std::thread::hardware_concurrency()), "", "pict./s", "wall", "95 %",
      "cpu", "step", "update", "hud", "draw", "share", "wanted/s");
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto done = kScenes[k](request.scenes).and_then([&](const Scene& scene) { return run(scene, all[k]); });
    if (!done) return tl::unexpected(done.error());
    report.text += row(all[k]);
    report.results.push_back({.name = fmt::format("view/{}", all[k].name),
                              .ms_per_step = median_ms(all[k]),
                              .real_time_factor = 1e3 * kPicture / median_ms(all[k])});
  }
  return report;
}

}  // namespace divot::bench
