#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "bench/bench.h"
#include "bench/repeat.h"

namespace divot::bench {
namespace {

// Eq. 14's C on the paper's grid: the vertices within the crater of 5000 t.
constexpr std::size_t kParticles = 98;
constexpr int kRepeats = 21;
// Policies may differ in what they cost, not in what comes out: m, between any two vertices of the final ground.
constexpr double kSameGround = 1e-3;

struct Policy {
  const char* name;
  const char* title;
  const char* update;  // TOML
};
constexpr Policy kPolicies[] = {{"every_step", "every step", "\"every_step\""},
                                {"every_10", "every 10 steps", "{ every = 10 }"},
                                {"adaptive", "adaptive", "\"adaptive\""}};
constexpr std::size_t kEveryStep = 0, kAdaptive = 2;

// A part of the step as the paper names it, and the stages it is made of.
struct Part {
  const char* name;
  std::vector<const char*> stages;
};
const Part kParts[] = {{"kd-tree", {"neighbours"}},      {"BVH", {"refit"}},
                       {"collision", {"contact"}},       {"forces", {"forces"}},
                       {"integration", {"integration"}}, {"rest", {"events", "activation", "settle"}}};

// The paper's scene in its second after the explosion. The ball drops straight into the crater and rolls there, inside
// the crater's particles: a ball that came from outside would wake others.
Result<Scene> scene(const std::string& scenes, const Policy& policy) {
  return load_scene((std::filesystem::path(scenes) / "paper.toml").string(),
                    {{"duration", "1.0"},
                     {"bombs.0.time", "0"},
                     {"solver.blast", "paper"},
                     {"solver.neighbours", "kd_tree"},
                     {"solver.neighbour_update", policy.update},
                     {"solver.bvh_update", policy.update},
                     {"bodies.0.position", "[-8, 2, 75.5]"},
                     {"bodies.0.velocity", "[15, 0, -40]"},
                     {"bodies.0.angular_velocity", "[0, 0, 0]"}});
}

double part_ms(const Measurement& m, const Part& part) {
  double ms = 0;
  for (const StageTime& stage : m.stages)
    for (const char* name : part.stages)
      if (std::string_view(stage.name) == name) ms += stage.ms;
  return ms;
}

double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0;
  for (std::size_t v = 0; v < a.size(); ++v) largest = std::max<double>(largest, length(a[v] - b[v]));
  return largest;
}

// The figure is of 98 particles and of one result, or it is not drawn.
Result<void> check_claim(const std::vector<Outcome>& outcomes) {
  for (const Outcome& outcome : outcomes) {
    const Measurement& m = outcome.measurement;
    if (m.particles != kParticles)
      return fail({.key = m.name,
                   .problem = fmt::format("{} particles were awake at once", m.particles),
                   .expected = fmt::format("expected {}", kParticles)});
  }
  const double apart = largest_distance(outcomes[kAdaptive].surface, outcomes[kEveryStep].surface);
  if (apart < kSameGround) return {};
  return fail({.key = "figure1",
               .problem = fmt::format("adaptive and every step end {:.3g} m apart", apart),
               .expected = fmt::format("expected less than {} m", kSameGround)});
}

std::string times_table(const std::vector<Outcome>& outcomes) {
  std::string text = fmt::format("{:<16}", "ms");
  for (const Policy& policy : kPolicies) text += fmt::format("{:>16}", policy.title);
  text += fmt::format("{:>20}\n", "every step/adaptive");
  for (const Part& part : kParts) {
    text += fmt::format("{:<16}", part.name);
    for (const Outcome& outcome : outcomes) text += fmt::format("{:>16.3f}", part_ms(outcome.measurement, part));
    text += fmt::format("{:>20.1f}\n", part_ms(outcomes[kEveryStep].measurement, part) /
                                           part_ms(outcomes[kAdaptive].measurement, part));
  }
  return text;
}

std::string facts_table(const std::vector<Outcome>& outcomes) {
  std::string text;
  const auto row = [&](const char* name, auto cell) {
    text += fmt::format("{:<16}", name);
    for (const Outcome& outcome : outcomes) text += fmt::format("{:>16}", cell(outcome));
    text += '\n';
  };
  row("kd-tree rebuilds", [](const Outcome& o) { return o.measurement.updates.neighbour_rebuilds; });
  row("BVH refits", [](const Outcome& o) { return o.measurement.updates.bvh_refits; });
  row("BVH rebuilds", [](const Outcome& o) { return o.measurement.updates.bvh_rebuilds; });
  row("missed pairs", [](const Outcome& o) { return o.measurement.updates.missed_pairs; });
  row("ground apart, mm", [&](const Outcome& o) {
    return fmt::format("{:.3g}", 1e3 * largest_distance(o.surface, outcomes[kEveryStep].surface));
  });
  row("state", [](const Outcome& o) { return fmt::format("{:016x}", o.measurement.state_hash); });
  return text;
}

cli::BarChart chart(const std::vector<Outcome>& outcomes) {
  cli::BarChart chart{.name = "figure1",
                      .title = fmt::format("Parts of 1000 ms of simulation ({} particles)", kParticles),
                      .y_label = "time, ms",
                      .log_scale = true};
  for (const Part& part : kParts) chart.labels.emplace_back(part.name);
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    chart.series.push_back({kPolicies[k].title, {}});
    for (const Part& part : kParts) chart.series.back().values.push_back(part_ms(outcomes[k].measurement, part));
  }
  return chart;
}

}  // namespace

Result<Report> figure1(const Request& request) {
  std::vector<Case> cases;
  for (const Policy& policy : kPolicies) {
    auto loaded = scene(request.scenes, policy);
    if (!loaded) return tl::unexpected(loaded.error());
    cases.push_back({fmt::format("figure1/{}", policy.name), std::move(*loaded)});
  }
  const auto outcomes = repeat(cases, kRepeats);
  if (!outcomes) return tl::unexpected(outcomes.error());
  if (const auto checked = check_claim(*outcomes); !checked) return tl::unexpected(checked.error());

  Report report;
  report.text = fmt::format("figure1: 1000 ms of simulation, {} particles, median of {} runs\n", kParticles, kRepeats) +
                times_table(*outcomes) + facts_table(*outcomes);
  for (const Outcome& outcome : *outcomes) report.results.push_back(outcome.measurement);
  report.charts.push_back(chart(*outcomes));
  return report;
}

}  // namespace divot::bench
