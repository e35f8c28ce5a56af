#include "validation/runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <thread>

#include "validation/families.h"

namespace divot::validation {
namespace {

// Whether `name` is asked for by `wanted`: the same, or its beginning up to a slash.
bool is_asked(const std::string& name, const std::string& wanted) {
  return name == wanted || (name.size() > wanted.size() && name.starts_with(wanted) && name[wanted.size()] == '/');
}

std::string known_names() {
  std::string known;
  for (const Family& family : families())
    known += fmt::format("{}{} ({})", known.empty() ? "" : ", ", family.name, family.what);
  return known;
}

// Takes what `names` ask for out of a family; marks the names that found something.
Chosen take(const Family& family, std::vector<Experiment> all, const std::vector<std::string>& names,
            std::vector<bool>& found) {
  Chosen chosen{&family, {}};
  for (Experiment& experiment : all) {
    bool wanted = names.empty();
    for (std::size_t k = 0; k < names.size(); ++k) {
      const bool whole = names[k] == family.name;
      const bool here = whole || std::any_of(experiment.cases.begin(), experiment.cases.end(),
                                             [&](const Case& one) { return is_asked(one.name, names[k]); });
      if (here) found[k] = true, wanted = true;
    }
    if (wanted) chosen.experiments.push_back(std::move(experiment));
  }
  return chosen;
}

std::vector<Finding> judge(const Experiment& experiment, const Result<Outcome>& outcome) {
  std::vector<Finding> findings;
  std::string problem;
  if (!outcome)
    problem = outcome.error().front().text();
  else if (outcome->simulated.size() != experiment.cases.size())
    problem = fmt::format("{} values for {} cases", outcome->simulated.size(), experiment.cases.size());
  for (std::size_t k = 0; k < experiment.cases.size(); ++k)
    findings.push_back({experiment.cases[k],
                        problem.empty() ? outcome->simulated[k] : std::numeric_limits<double>::quiet_NaN(), problem});
  return findings;
}

}  // namespace

Result<std::vector<Chosen>> choose(const std::vector<std::string>& names, const Places& places) {
  std::vector<Chosen> chosen;
  std::vector<bool> found(names.size());
  for (const Family& family : families()) {
    auto experiments = family.make(places);
    if (!experiments) return tl::unexpected(experiments.error());
    Chosen taken = take(family, std::move(*experiments), names, found);
    if (!taken.experiments.empty()) chosen.push_back(std::move(taken));
  }
  for (std::size_t k = 0; k < names.size(); ++k)
    if (!found[k])
      return fail({.file = "divot validate",
                   .problem = fmt::format("there is no \"{}\"", names[k]),
                   .expected = "there is " + known_names() + "; --list names every case"});
  return chosen;
}

Findings run(const std::vector<Chosen>& chosen, int threads, const std::function<void(double)>& done) {
  std::vector<const Experiment*> all;
  for (const Chosen& family : chosen)
    for (const Experiment& experiment : family.experiments) all.push_back(&experiment);
  std::vector<Result<Outcome>> outcomes(all.size());

  // Each takes the next that nobody has taken; what comes out has its place from the start.
  std::atomic<std::size_t> next = 0, finished = 0;
  std::mutex telling;
  const auto work = [&] {
    for (std::size_t k = next++; k < all.size(); k = next++) {
      outcomes[k] = all[k]->run();
      const std::size_t now = ++finished;
      const std::lock_guard lock(telling);
      done(static_cast<double>(now) / static_cast<double>(all.size()));
    }
  };
  const unsigned wanted = threads > 0 ? static_cast<unsigned>(threads) : std::thread::hardware_concurrency();
  std::vector<std::thread> workers;
  for (unsigned k = 1; k < std::min<std::size_t>(wanted, all.size()); ++k) workers.emplace_back(work);
  work();
  for (std::thread& worker : workers) worker.join();

  Findings findings;
  std::size_t k = 0;
  for (const Chosen& family : chosen) {
    findings.families.emplace_back();
    for (const Experiment& experiment : family.experiments) {
      const std::vector<Finding> judged = judge(experiment, outcomes[k]);
      findings.families.back().insert(findings.families.back().end(), judged.begin(), judged.end());
      if (outcomes[k])
        findings.curves.insert(findings.curves.end(), outcomes[k]->curves.begin(), outcomes[k]->curves.end());
      ++k;
    }
  }
  return findings;
}

std::size_t failures(const Findings& findings) {
  std::size_t count = 0;
  for (const std::vector<Finding>& family : findings.families)
    count += static_cast<std::size_t>(std::count_if(
        family.begin(), family.end(), [](const Finding& finding) { return !passes(finding.what, finding.simulated); }));
  return count;
}

}  // namespace divot::validation
