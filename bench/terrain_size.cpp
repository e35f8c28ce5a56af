#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <ctime>
#include <fstream>
#include <memory>

#include "bench/stepping.h"

namespace divot::bench {
namespace {

constexpr std::array<int, 4> kSides = {100, 316, 1000, 3162};

double resident_bytes() {
  std::ifstream in("/proc/self/statm");
  double pages = 0, resident = 0;
  in >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

// The paper's crater in the middle of more and more ground.
Scene scene(int side) {
  Scene scene;
  scene.name = "terrain_size";
  scene.terrain.shape = GridTerrain{.columns = side, .rows = side, .spacing = 10.9};
  scene.bombs = {{.time = 0, .position = {2, 2, 0}, .yield = 5000}};
  return scene;
}

struct Loaded {
  Measurement measurement;
  double load_s = 0, bytes = 0;
};

Result<Loaded> measure(int side) {
  malloc_trim(0);
  const double before = resident_bytes();
  const std::clock_t start = std::clock();
  auto world = World::create(scene(side), std::make_shared<const Jobs>(1));
  if (!world) return tl::unexpected(world.error());
  Loaded loaded;
  loaded.load_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  malloc_trim(0);
  loaded.bytes = resident_bytes() - before;
  auto m = measure_steps("terrain_size", *world, {.warm_up = 5, .steps = 60});
  if (!m) return tl::unexpected(m.error());
  m->count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  loaded.measurement = std::move(*m);
  return loaded;
}

}  // namespace

Result<Report> terrain_size(const Request& request) {
  Report report;
  report.text = "terrain_size: the same crater of 5000 t on more and more ground\n";
  std::string facts;
  cli::CurveChart chart = curves("terrain_size", "A step of one crater by the size of the ground", "vertices");
  for (const int side : kSides) {
    if (static_cast<std::size_t>(side) * static_cast<std::size_t>(side) > request.most) continue;
    auto loaded = measure(side);
    if (!loaded) return tl::unexpected(loaded.error());
    const auto vertices = static_cast<double>(loaded->measurement.count);
    facts += fmt::format("{:>10} vertices: loaded in {:.2f} s of CPU time, {:.0f} bytes resident for each\n", vertices,
                         loaded->load_s, loaded->bytes / vertices);
    add_point(chart, "CPU", vertices, loaded->measurement.cpu_ms_per_step);
    report.results.push_back(std::move(loaded->measurement));
  }
  report.text += table(report.results, "vertices") + facts;
  if (!report.results.empty()) report.line_charts.push_back(chart);
  return report;
}

}  // namespace divot::bench
