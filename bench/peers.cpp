#include "bench/peers.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "bench/stepping.h"

namespace divot::bench {
namespace {

// A line for each time; peers say how many times divot's theirs is.
std::string text_of(const std::vector<PeerTime>& times) {
  std::string text = "peers: the same work by divot and by others, CPU time of one thread\n";
  double own = 0;
  for (const PeerTime& t : times) {
    if (t.who == "divot") own = t.ns;
    if (t.ns == 0) {
      text += fmt::format("{:<26}{:<30}skipped: {}\n", t.task, t.who, t.missing);
      continue;
    }
    text += fmt::format("{:<26}{:<30}{:>14.1f} ns for each of {} {}", t.task, t.who, t.ns, t.count, t.each);
    if (t.who != "divot" && own > 0) text += fmt::format(": {:.2g} times divot's", t.ns / own);
    text += '\n';
  }
  return text;
}

// A group of bars for each task; a bar for divot and one for each peer, in the order in which they come.
cli::BarChart chart_of(const std::vector<PeerTime>& times) {
  cli::BarChart chart{.name = "peers",
                      .title = "The same work by divot and by others",
                      .y_label = "times divot's CPU time",
                      .labels = {},
                      .series = {{"divot", {}}, {"peer", {}}},
                      .log_scale = true};
  double own = 0;
  for (const PeerTime& t : times) {
    if (t.who == "divot") own = t.ns;
    if (t.who == "divot" || t.ns == 0 || own == 0) continue;
    chart.labels.push_back(t.task + ": " + t.who);
    chart.series[0].values.push_back(1);
    chart.series[1].values.push_back(t.ns / own);
  }
  return chart;
}

}  // namespace

double cpu_ns(const std::function<void()>& work) {
  std::vector<double> times;
  double sum = 0;
  while (times.size() < 5 || sum < 1e8) {
    const std::clock_t start = std::clock();
    work();
    times.push_back(1e9 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    sum += times.back();
    if (times.size() > 100'000) break;
  }
  return median(times);
}

Result<Report> peers(const Request& request) {
  std::vector<PeerTime> times;
  for (const auto compare : {&compare_forces, &compare_neighbours, &compare_surfaces})
    if (const auto done = compare(times); !done) return tl::unexpected(done.error());
  if (const auto done = compare_rolling(request.scenes, times); !done) return tl::unexpected(done.error());

  Report report;
  report.text = text_of(times);
  for (const PeerTime& t : times) {
    if (t.ns == 0) continue;
    Measurement m{.name = fmt::format("peers/{}/{}", t.task, t.who), .particles = t.count, .count = t.count};
    m.ns_per_particle_step = t.ns;
    m.ms_per_step = m.cpu_ms_per_step = 1e-6 * t.ns * static_cast<double>(t.count);
    report.results.push_back(m);
  }
  const cli::BarChart chart = chart_of(times);
  if (!chart.labels.empty()) report.charts.push_back(chart);
  return report;
}

}  // namespace divot::bench
