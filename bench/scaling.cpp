#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bench/stepping.h"

namespace divot::bench {
namespace {

constexpr std::array<int, 6> kSides = {10, 32, 100, 316, 1000, 1414};  // vertices along each side of the ground
constexpr std::array<int, 2> kThreads = {1, 2};

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
Result<void> disturb(World& world, int side, int step) {
  if (step % 20 != 0) return {};
  const double width = 10.9 * side, sign = step % 40 == 0 ? 1 : -1;
  const std::array<GroundPush, 3> pushes = {
      GroundPush{.radius = 2 * width, .velocity = {0.2 * sign, 0.1, 0.4 * sign}},
      GroundPush{.position = {0.2 * width, 0.1 * width, 0}, .radius = 0.3 * width, .velocity = {0, 0.3, 0.5 * sign}},
      GroundPush{
          .position = {-0.3 * width, -0.2 * width, 0}, .radius = 0.2 * width, .velocity = {0.3, 0, -0.5 * sign}}};
  for (const GroundPush& push : pushes)
    if (const auto done = world.push_ground(push); !done) return done;
  return {};
}

Result<Measurement> measure(int side, const Way& way, int threads) {
  const auto particles = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  const auto all_awake = [&](const World& world, const StepReport& report) -> Result<void> {
    if (world.particles().x.size() == particles && report.substeps == 1) return {};
    return fail({.key = "scaling",
                 .problem = fmt::format("{} particles awake, {} substeps", world.particles().x.size(), report.substeps),
                 .expected = fmt::format("{} and one", particles)});
  };
  return measure_steps(fmt::format("scaling/{}", way.name), scene(side, way.integrator),
                       {.threads = threads,
                        .steps = measured_steps(particles),
                        .before = [&](World& world, int step) { return disturb(world, side, step); },
                        .after = all_awake});
}

std::string header(const Measurement& m) {
  std::string text = fmt::format("{:<6}{:>10}{:>8}{:>11}{:>12}{:>10}{:>10}", "", "particles", "threads", "ms/step",
                                 "ns/particle", "CPU ns", "x real");
  for (const StageTime& stage : m.stages) text += fmt::format("{:>12}", stage.name);
  return text + "   (stages: ns/particle)\n";
}

std::string line(const Measurement& m, const Way& way) {
  const auto particles = static_cast<double>(m.particles);
  std::string text =
      fmt::format("{:<6}{:>10}{:>8}{:>11.3f}{:>12.1f}{:>10.1f}{:>10.2f}", way.name, m.particles, m.threads,
                  m.ms_per_step, m.ns_per_particle_step, 1e6 * m.cpu_ms_per_step / particles, m.real_time_factor);
  for (const StageTime& stage : m.stages) text += fmt::format("{:>12.1f}", 1e6 * stage.ms / (particles * m.steps));
  return text + "\n";
}

// One curve for each integrator and number of threads, and what real time would be.
cli::CurveChart chart(const std::vector<Measurement>& results) {
  cli::CurveChart chart = curves("scaling", "A step of 1/60 s with every particle awake", "particles");
  for (const Measurement& m : results)
    add_point(chart,
              fmt::format("{}, {} thread{}", m.name.substr(m.name.find('/') + 1), m.threads, m.threads == 1 ? "" : "s"),
              static_cast<double>(m.particles), m.ms_per_step);
  for (const Measurement& m : results) add_point(chart, "real time", static_cast<double>(m.particles), 1e3 / 60);
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
  if (!report.results.empty()) report.line_charts.push_back(chart(report.results));
  return report;
}

}  // namespace divot::bench
