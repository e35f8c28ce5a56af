#include "bench/upload.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "bench/view_scenes.h"
#include "viewer/upload_meter.h"

namespace divot::bench {
namespace {

constexpr int kWidth = 640, kHeight = 360;
constexpr int kFrames = 90;  // a step and a picture each
constexpr const char* kWays[] = {"what changed", "everything"};

// One scene shown one way: medians over its frames.
struct Row {
  double bytes = 0, step_ms = 0, update_ms = 0, draw_ms = 0;
  double picture_ms() const { return update_ms + draw_ms; }
};

struct Shown {
  const char* name;
  const char* title;
  std::size_t triangles = 0;
  Row rows[2];  // [way]
  Measurement measurements[2];
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Numbers of all frames of one way.
struct Samples {
  std::vector<double> bytes, update_ms, draw_ms;
  void add(const viewer::PictureCost& cost) {
    bytes.push_back(static_cast<double>(cost.bytes));
    update_ms.push_back(cost.update_ms);
    draw_ms.push_back(cost.draw_ms);
  }
};

Measurement measurement_of(const Shown& shown, std::size_t way, const World& world) {
  const double frame_ms = shown.rows[way].step_ms + shown.rows[way].picture_ms();
  return {.name = fmt::format("upload/{}/{}", shown.name, way == 0 ? "dirty" : "everything"),
          .particles = world.peak_particles(),
          .ms_per_step = frame_ms,
          .real_time_factor = 1e3 * world.scene().dt / frame_ms,
          .stages = world.stages(),
          .updates = world.updates(),
          .state_hash = world.state_hash()};
}

// Each state of the world is shown both ways, in turns first and second: a machine that slows down slows both, and what
// comes right after a step finds its caches cold.
Result<void> show(const Scene& scene, Shown& shown) {
  auto world = World::create(scene);
  if (!world) return tl::unexpected(world.error());
  auto meter = viewer::UploadMeter::create(*world, kWidth, kHeight);
  if (!meter) return tl::unexpected(meter.error());

  const auto vertices = static_cast<std::uint32_t>(world->surface().positions.size());
  shown.triangles = world->surface().triangles.size() / 3;
  std::vector<double> step_ms;
  Samples samples[2];
  for (int frame = 0; frame < kFrames; ++frame) {
    const auto start = std::chrono::steady_clock::now();
    world->step();
    step_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    const std::vector<DirtyRange> ranges[2] = {world->take_dirty(), {{0, vertices}}};
    for (const std::size_t turn : {0, 1}) {
      const std::size_t way = (static_cast<std::size_t>(frame) + turn) % 2;
      samples[way].add(meter->show(*world, ranges[way]));
    }
  }
  for (std::size_t way = 0; way < 2; ++way) {
    shown.rows[way] = {median(samples[way].bytes), median(step_ms), median(samples[way].update_ms),
                       median(samples[way].draw_ms)};
    shown.measurements[way] = measurement_of(shown, way, *world);
  }
  if (shown.rows[0].bytes > 0) return {};
  return fail({.key = fmt::format("upload/{}", shown.name),
               .problem = "in most pictures no ground moved",
               .expected = "expected something to send"});
}

std::string table(const std::vector<Shown>& all) {
  std::string text = fmt::format("{:<32}{:<14}{:>14}{:>12}{:>12}{:>12}\n", "median of a picture", "sent", "bytes",
                                 "update, ms", "draw, ms", "both, ms");
  for (const Shown& shown : all) {
    for (std::size_t way = 0; way < 2; ++way) {
      const Row& row = shown.rows[way];
      text += fmt::format("{:<32}{:<14}{:>14.0f}{:>12.2f}{:>12.2f}{:>12.2f}\n",
                          fmt::format("{}, {} triangles", shown.title, shown.triangles), kWays[way], row.bytes,
                          row.update_ms, row.draw_ms, row.picture_ms());
    }
  }
  return text;
}

template <class Value>
cli::BarChart chart(const std::vector<Shown>& all, const char* name, const char* title, const char* unit, bool log,
                    Value value) {
  cli::BarChart chart{.name = name, .title = title, .y_label = unit, .log_scale = log};
  for (const Shown& shown : all) chart.labels.emplace_back(shown.title);
  for (std::size_t way = 0; way < 2; ++way) {
    chart.series.push_back({kWays[way], {}});
    for (const Shown& shown : all) chart.series.back().values.push_back(value(shown.rows[way]));
  }
  return chart;
}

}  // namespace

Result<Report> upload(const Request& request) {
  std::vector<Shown> all = {{.name = "paper", .title = "paper"}, {.name = "rolling", .title = "rolling ball"}};
  constexpr Result<Scene> (*kScenes[])(const std::string&) = {&paper_scene, &rolling_scene};
  Report report;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto done = kScenes[k](request.scenes).and_then([&](const Scene& scene) { return show(scene, all[k]); });
    if (!done) return tl::unexpected(done.error());
    for (const Measurement& m : all[k].measurements) report.results.push_back(m);
  }
  report.text = fmt::format("upload: {} pictures of {} x {} pixels, each sent both ways\n", kFrames, kWidth, kHeight) +
                table(all);
  report.charts = {
      chart(all, "upload_bytes", "Sent for a picture", "bytes", true, [](const Row& row) { return row.bytes; }),
      chart(all, "upload_ms", "Time for a picture", "time, ms", false,
            [](const Row& row) { return row.picture_ms(); })};
  return report;
}

}  // namespace divot::bench
