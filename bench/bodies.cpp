#include <fmt/format.h>

#include <array>
#include <cmath>

#include "bench/stepping.h"

namespace divot::bench {
namespace {

constexpr std::array<int, 4> kBalls = {1, 10, 100, 1000};
constexpr std::array<int, 3> kBombs = {1, 10, 100};
constexpr int kAcross = 32;       // places along each side of the ground
constexpr double kApart = 3;      // m between places
constexpr double kSpacing = 0.2;  // m

Vec3d place(int k, int of) {
  // Spread over the whole ground, whatever their number is.
  const int at = static_cast<int>((static_cast<long>(k) * kAcross * kAcross) / of);
  return {kApart * (at % kAcross - kAcross / 2), kApart * (at / kAcross - kAcross / 2), 0};
}

Scene ground() {
  Scene scene;
  scene.name = "bodies";
  const int side = static_cast<int>(kAcross * kApart / kSpacing) + 41;
  scene.terrain = {.shape = GridTerrain{.columns = side, .rows = side, .spacing = kSpacing}, .material = "dry_sand"};
  return scene;
}

Scene with_balls(int count) {
  Scene scene = ground();
  for (int k = 0; k < count; ++k)
    scene.bodies.push_back({.name = fmt::format("ball {}", k),
                            .shape = Sphere{0.5},
                            .mass = 500,
                            .position = place(k, count),
                            .above_ground = true,
                            .velocity = {2, 0, 0},
                            .angular_velocity = {0, 4, 0}});
  return scene;
}

Scene with_bombs(int count) {
  Scene scene = ground();
  for (int k = 0; k < count; ++k)
    scene.bombs.push_back({.time = 0.05, .position = place(k, count), .above_ground = true, .yield = 0.001});
  return scene;
}

Result<void> add(Report& report, const char* name, const Scene& scene, int count, int steps, int warm_up) {
  auto m = measure_steps(fmt::format("bodies/{}", name), scene, {.warm_up = warm_up, .steps = steps});
  if (!m) return tl::unexpected(m.error());
  m->count = static_cast<std::size_t>(count);
  report.results.push_back(std::move(*m));
  return {};
}

}  // namespace

Result<Report> bodies(const Request& request) {
  Report report;
  report.text = "bodies: rolling balls and bombs that go off together, on one ground of 270,000 vertices\n";
  for (const int count : kBalls)
    if (static_cast<std::size_t>(count) <= request.most)
      if (const auto done = add(report, "balls", with_balls(count), count, 30, 30); !done)
        return tl::unexpected(done.error());
  // Measured while the craters form: 0.1 s from the explosion on.
  for (const int count : kBombs)
    if (static_cast<std::size_t>(count) <= request.most)
      if (const auto done = add(report, "bombs", with_bombs(count), count, 6, 3); !done)
        return tl::unexpected(done.error());
  report.text += table(report.results, "count");
  cli::CurveChart chart = curves("bodies", "A step by bodies and bombs, one thread", "balls or bombs");
  for (const Measurement& m : report.results) {
    add_point(chart, m.name, static_cast<double>(m.count), m.ms_per_step);
    report.text += fmt::format("{} {}: {:.1f} us CPU each\n", m.count, m.name,
                               1e3 * m.cpu_ms_per_step / static_cast<double>(m.count));
  }
  if (!report.results.empty()) report.line_charts.push_back(chart);
  return report;
}

}  // namespace divot::bench
