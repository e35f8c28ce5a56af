#include "bench/bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "bench/machine.h"
#include "cli/charts.h"
#include "cli/commands.h"
#include "cli/installed.h"
#include "cli/scene_input.h"
#include "output/atomic_file.h"
#include "output/json.h"

namespace divot::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Result<std::vector<bench::Bench>> choose(const std::vector<std::string>& names) {
  const auto all = bench::benches();
  if (names.empty()) return std::vector<bench::Bench>(all.begin(), all.end());
  std::vector<bench::Bench> chosen;
  for (const std::string& name : names) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const bench::Bench& b) { return b.name == name; });
    if (found != all.end()) {
      chosen.push_back(*found);
      continue;
    }
    std::string known;
    for (const bench::Bench& b : all) known += fmt::format("{}{} ({})", known.empty() ? "" : ", ", b.name, b.what);
    return fail(
        {.file = "divot bench", .problem = fmt::format("there is no \"{}\"", name), .expected = "there is " + known});
  }
  return chosen;
}

Json to_json(const bench::Measurement& m) {
  Json stages = Json::object();
  for (const StageTime& stage : m.stages) stages[stage.name] = {{"ms", stage.ms}, {"calls", stage.calls}};
  return {{"name", m.name},
          {"particles", m.particles},
          {"count", m.count},
          {"threads", m.threads},
          {"ms_per_step", m.ms_per_step},
          {"ns_per_particle_step", m.ns_per_particle_step},
          {"cpu_ms_per_step", m.cpu_ms_per_step},
          {"real_time_factor", m.real_time_factor},
          {"stages", stages},
          {"updates",
           {{"neighbour_rebuilds", m.updates.neighbour_rebuilds},
            {"bvh_refits", m.updates.bvh_refits},
            {"bvh_rebuilds", m.updates.bvh_rebuilds},
            {"missed_pairs", m.updates.missed_pairs}}},
          {"state_hash", fmt::format("{:016x}", m.state_hash)}};
}

}  // namespace

int bench(const BenchOptions& options) {
  const auto chosen = choose(options.names);
  if (!chosen) return report(chosen.error(), kBadInput);
  const std::string machine = bench::machine();
  fmt::print("machine: {}\n", machine);
  Json json = {{"machine", machine}, {"results", Json::array()}};
  for (const bench::Bench& one : *chosen) {
    const auto measured = one.run({.scenes = scenes_folder(options.scenes), .most = options.most});
    if (!measured) return report(measured.error(), kFailed);
    fmt::print("{}", measured->text);
    for (const bench::Measurement& m : measured->results) json["results"].push_back(to_json(m));
    const std::string folder = options.out.empty() ? (fs::path("out") / "bench").string() : options.out;
    if (const auto written = write_charts(measured->charts, folder); !written) return report(written.error(), kFailed);
    if (const auto written = write_charts(measured->line_charts, folder); !written)
      return report(written.error(), kFailed);
  }
  if (options.json.empty()) return kDone;
  const auto written = output::write_json(options.json, json);
  return written ? kDone : report(written.error(), kFailed);
}

}  // namespace divot::cli
