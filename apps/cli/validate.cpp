#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "cli/charts.h"
#include "cli/commands.h"
#include "cli/installed.h"
#include "cli/progress.h"
#include "cli/scene_input.h"
#include "output/atomic_file.h"
#include "output/json.h"
#include "validation/figures.h"
#include "validation/page.h"
#include "validation/runner.h"

namespace divot::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using validation::Bound;
using validation::Case;
using validation::Finding;

std::string percent(double share) {
  if (std::isnan(share)) return "";
  return share >= 1e-3 || share < 1e-5 ? fmt::format("{:.1f} %", 100 * share) : fmt::format("{:.1g} %", 100 * share);
}

bool is_limit(const Case& one) { return one.bound == Bound::at_most || one.bound == Bound::at_least; }

void print_head(const char* simulated) {
  fmt::print("{:<38} {:<14} {:>13} {:>10} {:>9} {:>10}  {:<4}  {}\n", "case", "unit", "measured", simulated, "error",
             "tolerance", "", "quantity; source");
}

void print_row(const Finding& finding) {
  const Case& one = finding.what;
  const double error = relative_error(one, finding.simulated);
  fmt::print("{:<38} {:<14} {:>13} {:>10} {:>9} {:>10}  {:<4}  {}; {}\n", one.name, one.unit, measured_text(one),
             fmt::format("{:.4g}", finding.simulated), percent(error), is_limit(one) ? "limit" : percent(one.tolerance),
             passes(one, finding.simulated) ? "pass" : "FAIL", one.quantity,
             finding.problem.empty() ? one.source : one.source + "; " + finding.problem);
}

void print_list(const std::vector<validation::Chosen>& chosen) {
  fmt::print("{:<38} {:<14} {:>13} {:>10}  {}\n", "case", "unit", "measured", "tolerance", "quantity; source");
  for (const validation::Chosen& family : chosen)
    for (const validation::Experiment& experiment : family.experiments)
      for (const Case& one : experiment.cases)
        fmt::print("{:<38} {:<14} {:>13} {:>10}  {}; {}\n", one.name, one.unit, measured_text(one),
                   is_limit(one) ? "limit" : percent(one.tolerance), one.quantity, one.source);
}

// JSON has no word for what is not a number.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json to_json(const Finding& finding) {
  static constexpr const char* kBounds[] = {"about", "between", "at_most", "at_least"};
  const Case& one = finding.what;
  Json json = {{"name", one.name},
               {"source", one.source},
               {"quantity", one.quantity},
               {"unit", one.unit},
               {"measured", one.measured},
               {"simulated", number(finding.simulated)},
               {"relative_error", number(relative_error(one, finding.simulated))},
               {"tolerance", one.tolerance},
               {"pass", passes(one, finding.simulated)},
               {"bound", kBounds[static_cast<std::size_t>(one.bound)]}};
  if (one.bound == Bound::between) json["measured_range"] = {range_low(one), range_high(one)};
  if (!finding.problem.empty()) json["problem"] = finding.problem;
  return json;
}

Result<void> write_json(const std::string& path, const validation::Findings& findings) {
  Json cases = Json::array();
  for (const std::vector<Finding>& family : findings.families)
    for (const Finding& finding : family) cases.push_back(to_json(finding));
  return output::write_json(path, {{"cases", cases}});
}

Result<void> write_page(const std::string& folder, const std::string& text) {
  if (const auto made = output::make_folder(folder); !made) return made;
  auto file = output::AtomicFile::create((fs::path(folder) / "validation.md").string());
  if (!file) return tl::unexpected(file.error());
  file->write(text);
  return file->commit();
}

void print_findings(const validation::Findings& findings, double wall_s) {
  print_head("simulated");
  std::size_t count = 0;
  for (const std::vector<Finding>& family : findings.families)
    for (const Finding& finding : family) print_row(finding), ++count;
  const std::size_t failed = failures(findings);
  fmt::print("{} cases, {} passed, {} failed, {:.0f} s\n", count, count - failed, failed, wall_s);
}

}  // namespace

int validate(const ValidateOptions& options) {
  const validation::Places places{scenes_folder(options.scenes), data_folder(options.data)};
  const auto chosen = validation::choose(options.names, places);
  if (!chosen) return report(chosen.error(), kBadInput);
  if (options.list) return print_list(*chosen), kDone;
  if (!options.docs.empty() && !options.names.empty())
    return report({{.file = "divot validate", .problem = "--docs writes of all cases", .expected = "leave names out"}},
                  kBadInput);

  const auto start = std::chrono::steady_clock::now();
  Progress progress(1, true);
  const validation::Findings findings =
      validation::run(*chosen, options.threads, [&](double share) { progress.update(share); });
  progress.clear();
  print_findings(findings, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());

  const std::vector<CurveChart> charts = validation::figures(findings.curves);
  const std::string folder = !options.docs.empty()  ? (fs::path(options.docs) / "validation").string()
                             : !options.out.empty() ? options.out
                                                    : (fs::path("out") / "validate").string();
  if (const auto drawn = write_charts(charts, folder); !drawn) return report(drawn.error(), kFailed);
  if (!options.docs.empty()) {
    const auto text = validation::page(*chosen, findings, charts, places);
    if (!text) return report(text.error(), kFailed);
    if (const auto written = write_page(options.docs, *text); !written) return report(written.error(), kFailed);
  }
  if (!options.json.empty())
    if (const auto written = write_json(options.json, findings); !written) return report(written.error(), kFailed);
  return failures(findings) == 0 ? kDone : kFailed;
}

}  // namespace divot::cli
