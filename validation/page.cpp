#include "validation/page.h"

#include <fmt/format.h>

#include <cmath>

#include "validation/data.h"

namespace divot::validation {
namespace {

constexpr const char* kIntroduction =
    "# Validation\n\n"
    "What divot simulates, held against what was measured or published. This page is written by\n"
    "`divot validate --docs docs`; a test holds that its cases are those that the program knows. Nothing is left out\n"
    "because it fails.\n\n"
    "`measured` is what the source says: a value, a range, or a limit. `error` is relative to it; for a range to its\n"
    "middle, for a limit how far beyond it. The data lie in [validation/data](../validation/data/README.md).\n";

std::string number(double value) { return std::isnan(value) ? "none" : fmt::format("{:.4g}", value); }
std::string percent(double share) {
  if (std::isnan(share)) return "";
  return share >= 1e-3 || share < 1e-5 ? fmt::format("{:.1f} %", 100 * share) : fmt::format("{:.1g} %", 100 * share);
}
std::string unit(const Case& one) { return one.unit == "1" ? "" : one.unit; }

// Text in a cell of a table.
std::string cell(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) text.insert(at, "\\");
  return text;
}

std::string table(const std::vector<Finding>& findings) {
  std::string text = "| case | source | quantity | measured | simulated | unit | error | tolerance | |\n";
  text += "|---|---|---|---|---|---|---|---|---|\n";
  for (const Finding& finding : findings) {
    const Case& one = finding.what;
    const bool limit = one.bound == Bound::at_most || one.bound == Bound::at_least;
    text += fmt::format("{} {} | {} | {} | {} | {} |\n", row_start(one), number(finding.simulated), unit(one),
                        percent(relative_error(one, finding.simulated)), limit ? "limit" : percent(one.tolerance),
                        passes(one, finding.simulated) ? "pass" : "**FAIL**");
  }
  return text;
}

Result<std::string> left_out(const Places& places) {
  const auto craters = measured_craters(places.data);
  if (!craters) return tl::unexpected(craters.error());
  std::string text = "\n## Left out\n\n";
  text +=
      "Nuclear craters are no cases: a nuclear burst at the ground makes a crater about half as wide as a chemical "
      "one\n"
      "of the same energy, because most of it leaves as radiation and heat. Predictions that do not say how deep the\n"
      "charge lay are none either.\n\n| shot | charge, t of TNT | height of burst, m | diameter, m | depth, m | why |\n"
      "|---|---|---|---|---|---|\n";
  for (const MeasuredCrater& crater : *craters) {
    const bool nuclear = crater.kind == "nuclear";
    if (!nuclear && !crater.material.empty() && !std::isnan(crater.height)) continue;
    text += fmt::format("| {} | {:.4g} | {} | {:.3g} | {:.3g} | {} |\n", cell(crater.shot), crater.charge / 1000,
                        std::isnan(crater.height) ? "" : fmt::format("{:.3g}", crater.height), crater.diameter,
                        crater.depth, nuclear ? "nuclear" : "depth of burst unknown");
  }
  return text;
}

}  // namespace

std::string row_start(const Case& one) {
  return fmt::format("| `{}` | {} | {} | {} |", one.name, cell(one.source), cell(one.quantity), measured_text(one));
}

Result<std::string> page(const std::vector<Chosen>& chosen, const Findings& findings,
                         const std::vector<cli::CurveChart>& charts, const Places& places) {
  std::size_t count = 0;
  for (const auto& family : findings.families) count += family.size();
  std::string text = kIntroduction;
  text += fmt::format("\nOf {} cases {} hold.\n", count, count - failures(findings));
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    text += fmt::format("\n## {}: {}\n\n", chosen[k].family->name, chosen[k].family->what);
    for (const cli::CurveChart& chart : charts)
      if (chart.name == chosen[k].family->figure)
        text += fmt::format("![{}](validation/{}.png)\n\n", chart.title, chart.name);
    text += table(findings.families[k]);
  }
  const auto rest = left_out(places);
  if (!rest) return tl::unexpected(rest.error());
  return text + *rest;
}

}  // namespace divot::validation
