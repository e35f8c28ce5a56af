#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <memory>

#include "bench/bench.h"

namespace divot::bench {
namespace {

constexpr std::array<int, 6> kSides = {10, 32, 100, 316, 1000, 1414};  // vertices along each side of the ground
constexpr std::array<int, 2> kThreads = {1, 2};
constexpr int kWarmUp = 3;

struct Way {
  Integrator integrator;
  const char* name;
};
constexpr std::array<Way, 2> kWays = {Way{Integrator::euler, "euler"}, Way{Integrator::rk4, "rk4"}};

// So many steps that each case takes about as long, and no fewer than a median needs.
int measured_steps(std::size_t particles) {
  return static_cast<int>(std::clamp<std::size_t>(10'000'000 / particles, 7, 200));
}

// The paper's medium, for which one substep of 1/60 s is enough at its spacing.
Scene scene(int side, Integrator integrator) {
  Scene scene;
  scene.name = "scaling";
  scene.terrain.shape = GridTerrain{.columns = side, .rows = side, .spacing = 10.9};
  scene.solver.integrator = integrator;
  return scene;
}

// Ground that heaves everywhere, more in some places than in others: no particle comes to rest.
Result<void> disturb(World& world, int side, std::uint64_t step) {
  const double width = 10.9 * side, sign = step % 2 == 0 ? 1 : -1;
  const std::array<GroundPush, 3> pushes = {
      GroundPush{.radius = 2 * width, .velocity = {0.2 * sign, 0.1, 0.4 * sign}},
      GroundPush{.position = {0.2 * width, 0.1 * width, 0}, .radius = 0.3 * width, .velocity = {0, 0.3, 0.5 * sign}},
      GroundPush{
          .position = {-0.3 * width, -0.2 * width, 0}, .radius = 0.2 * width, .velocity = {0.3, 0, -0.5 * sign}}};
  for (const GroundPush& push : pushes)
    if (const auto done = world.push_ground(push); !done) return done;
  return {};
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

Result<Measurement> measure(int side, const Way& way, int threads) {
  auto world = World::create(scene(side, way.integrator), std::make_shared<const Jobs>(threads));
  if (!world) return tl::unexpected(world.error());
  const auto particles = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  const int steps = measured_steps(particles);
  std::vector<double> ms;
  std::vector<StageTime> before;
  for (int k = 0; k < kWarmUp + steps; ++k) {
    if (k % 20 == 0)
      if (const auto done = disturb(*world, side, world->steps()); !done) return tl::unexpected(done.error());
    if (k == kWarmUp) before = world->stages();
    const auto start = std::chrono::steady_clock::now();
    const StepReport report = world->step();
    if (k >= kWarmUp)
      ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    if (world->particles().x.size() != particles || report.substeps != 1)
      return fail(
          {.key = "scaling",
           .problem = fmt::format("{} particles awake, {} substeps", world->particles().x.size(), report.substeps),
           .expected = fmt::format("{} and one", particles)});
  }

  Measurement m{.name = fmt::format("scaling/{}", way.name), .particles = particles, .threads = threads};
  m.ms_per_step = median(ms);
  m.ns_per_particle_step = 1e6 * m.ms_per_step / static_cast<double>(particles);
  m.real_time_factor = 1e3 * world->scene().dt / m.ms_per_step;
  m.stages = world->stages();
  for (std::size_t s = 0; s < m.stages.size(); ++s)
    m.stages[s].ms -= before[s].ms, m.stages[s].calls -= before[s].calls;
  m.updates = world->updates();
  m.state_hash = world->state_hash();
  return m;
}

std::string header(const Measurement& m) {
  std::string text =
      fmt::format("{:<6}{:>10}{:>8}{:>11}{:>12}{:>10}", "", "particles", "threads", "ms/step", "ns/particle", "x real");
  for (const StageTime& stage : m.stages) text += fmt::format("{:>12}", stage.name);
  return text + "   (stages: ns/particle)\n";
}

std::string line(const Measurement& m, const Way& way) {
  std::string text = fmt::format("{:<6}{:>10}{:>8}{:>11.3f}{:>12.1f}{:>10.2f}", way.name, m.particles, m.threads,
                                 m.ms_per_step, m.ns_per_particle_step, m.real_time_factor);
  const double count = static_cast<double>(m.particles) * measured_steps(m.particles);
  for (const StageTime& stage : m.stages) text += fmt::format("{:>12.1f}", 1e6 * stage.ms / count);
  return text + "\n";
}

// One curve for each integrator and number of threads, and what real time would be.
cli::CurveChart chart(const std::vector<Measurement>& results) {
  using Style = cli::CurveChart::Series::Style;
  cli::CurveChart chart{.name = "scaling",
                        .title = "A step of 1/60 s with every particle awake",
                        .x_label = "particles",
                        .y_label = "time for a step, ms",
                        .log_x = true,
                        .log_y = true};
  for (const Measurement& m : results) {
    const std::string name =
        fmt::format("{}, {} thread{}", m.name.substr(m.name.find('/') + 1), m.threads, m.threads == 1 ? "" : "s");
    auto series = std::find_if(chart.series.begin(), chart.series.end(), [&](const auto& s) { return s.name == name; });
    if (series == chart.series.end())
      series = chart.series.insert(series, {name, Style::joined, static_cast<int>(chart.series.size()), {}});
    series->points.emplace_back(static_cast<double>(m.particles), m.ms_per_step);
  }
  if (chart.series.empty()) return chart;
  const auto& first = chart.series.front().points;
  chart.series.push_back({"real time",
                          Style::dashes,
                          static_cast<int>(chart.series.size()),
                          {{first.front().first, 1e3 / 60}, {first.back().first, 1e3 / 60}}});
  return chart;
}

}  // namespace

Result<Report> scaling(const Request& request) {
  Report report;
  report.text = "scaling: a step of 1/60 s with every particle awake, medians over steps\n";
  for (const Way& way : kWays) {
    for (const int side : kSides) {
      if (static_cast<std::size_t>(side) * static_cast<std::size_t>(side) > request.most) continue;
      for (const int threads : kThreads) {
        const auto m = measure(side, way, threads);
        if (!m) return tl::unexpected(m.error());
        if (report.results.empty()) report.text += header(*m);
        if (threads != kThreads[0] && m->state_hash != report.results.back().state_hash)
          return fail({.key = m->name, .problem = fmt::format("{} particles: threads change bits", m->particles)});
        report.text += line(*m, way);
        report.results.push_back(*m);
      }
    }
  }
  report.line_charts.push_back(chart(report.results));
  return report;
}

}  // namespace divot::bench
