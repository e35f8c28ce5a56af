#include "bench/repeat.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

namespace divot::bench {
namespace {

// Numbers of all repeats of a case.
struct Samples {
  std::vector<double> wall_ms;
  std::vector<std::vector<double>> stage_ms;  // [stage][repeat]
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// One run from the start to the end. Making the world is not part of the time.
Result<void> run_once(const Case& one, const std::shared_ptr<const Jobs>& jobs, Samples& samples, Outcome& outcome) {
  auto world = World::create(one.scene, jobs);
  if (!world) return tl::unexpected(world.error());
  const auto steps = static_cast<std::uint64_t>(std::llround(one.scene.duration / one.scene.dt));
  const auto start = std::chrono::steady_clock::now();
  while (world->steps() < steps) world->step();
  samples.wall_ms.push_back(
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());

  Measurement& m = outcome.measurement;
  const bool first = samples.wall_ms.size() == 1;
  if (!first && m.state_hash != world->state_hash())
    return fail({.key = one.name, .problem = "two runs of the same scene ended in different bits"});
  m.stages = world->stages();
  m.particles = world->peak_particles();
  m.updates = world->updates();
  m.state_hash = world->state_hash();
  samples.stage_ms.resize(m.stages.size());
  for (std::size_t k = 0; k < m.stages.size(); ++k) samples.stage_ms[k].push_back(m.stages[k].ms);
  if (first) outcome.surface.assign(world->surface().positions.begin(), world->surface().positions.end());
  return {};
}

void take_medians(const Case& one, const Samples& samples, Measurement& m) {
  const double wall_ms = median(samples.wall_ms), steps = std::round(one.scene.duration / one.scene.dt);
  m.name = one.name;
  m.ms_per_step = wall_ms / steps;
  m.ns_per_particle_step = m.particles > 0 ? 1e6 * m.ms_per_step / static_cast<double>(m.particles) : 0;
  m.real_time_factor = 1e3 * one.scene.duration / wall_ms;
  for (std::size_t k = 0; k < m.stages.size(); ++k) m.stages[k].ms = median(samples.stage_ms[k]);
}

}  // namespace

Result<std::vector<Outcome>> repeat(const std::vector<Case>& cases, int repeats) {
  const auto jobs = std::make_shared<const Jobs>(1);
  std::vector<Outcome> outcomes(cases.size());
  std::vector<Samples> samples(cases.size());
  for (int k = 0; k < repeats; ++k)
    for (std::size_t c = 0; c < cases.size(); ++c)
      if (const auto done = run_once(cases[c], jobs, samples[c], outcomes[c]); !done)
        return tl::unexpected(done.error());
  for (std::size_t c = 0; c < cases.size(); ++c) take_medians(cases[c], samples[c], outcomes[c].measurement);
  return outcomes;
}

}  // namespace divot::bench
