#include "bench/stepping.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <memory>

namespace divot::bench {
namespace {

double cpu_ms() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double wall_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

Result<Measurement> measure_steps(const std::string& name, World& world, const Stepping& how) {
  std::vector<double> wall, cpu;
  std::vector<StageTime> before = world.stages();
  for (int k = 0; k < how.warm_up + how.steps; ++k) {
    if (how.before)
      if (const auto done = how.before(world, k); !done) return tl::unexpected(done.error());
    if (k == how.warm_up) before = world.stages();
    const double wall_start = wall_ms(), cpu_start = cpu_ms();
    const StepReport report = world.step();
    if (k < how.warm_up) continue;
    wall.push_back(wall_ms() - wall_start), cpu.push_back(cpu_ms() - cpu_start);
    if (how.after)
      if (const auto right = how.after(world, report); !right) return tl::unexpected(right.error());
  }
  Measurement m{.name = name, .particles = world.particles().x.size(), .threads = how.threads, .steps = how.steps};
  m.ms_per_step = median(wall), m.cpu_ms_per_step = median(cpu);
  m.ns_per_particle_step = m.particles > 0 ? 1e6 * m.ms_per_step / static_cast<double>(m.particles) : 0;
  m.real_time_factor = 1e3 * world.scene().dt / m.ms_per_step;
  m.stages = world.stages();
  for (std::size_t s = 0; s < m.stages.size(); ++s)
    m.stages[s].ms -= before[s].ms, m.stages[s].calls -= before[s].calls;
  m.updates = world.updates();
  m.state_hash = world.state_hash();
  return m;
}

Result<Measurement> measure_steps(const std::string& name, const Scene& scene, const Stepping& how) {
  auto world = World::create(scene, std::make_shared<const Jobs>(how.threads));
  if (!world) return tl::unexpected(world.error());
  return measure_steps(name, *world, how);
}

cli::CurveChart curves(const char* name, const char* title, const char* x_label) {
  return {
      .name = name, .title = title, .x_label = x_label, .y_label = "time for a step, ms", .log_x = true, .log_y = true};
}

void add_point(cli::CurveChart& chart, const std::string& name, double x, double y) {
  auto series = std::find_if(chart.series.begin(), chart.series.end(), [&](const auto& s) { return s.name == name; });
  if (series == chart.series.end())
    series = chart.series.insert(
        series, {name, cli::CurveChart::Series::Style::joined, static_cast<int>(chart.series.size()), {}});
  series->points.emplace_back(x, y);
}

std::string table(const std::vector<Measurement>& results, const char* count_name) {
  if (results.empty()) return {};
  std::string text = fmt::format("{:<18}{:>10}{:>10}{:>8}{:>11}{:>11}{:>9}", "", count_name, "particles", "threads",
                                 "ms/step", "CPU ms", "x real");
  for (const StageTime& stage : results[0].stages) text += fmt::format("{:>12}", stage.name);
  text += "  (us/step)\n";
  for (const Measurement& m : results) {
    text += fmt::format("{:<18}{:>10}{:>10}{:>8}{:>11.3f}{:>11.3f}{:>9.2f}", m.name, m.count, m.particles, m.threads,
                        m.ms_per_step, m.cpu_ms_per_step, m.real_time_factor);
    for (const StageTime& stage : m.stages) text += fmt::format("{:>12.1f}", 1e3 * stage.ms / m.steps);
    text += '\n';
  }
  return text;
}

}  // namespace divot::bench
