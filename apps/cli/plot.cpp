#include "cli/plot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "output/atomic_file.h"

extern char** environ;

namespace divot::cli {
namespace {

constexpr std::array kColors = {"#8b97a5", "#e09f3e", "#2a6fb0", "#5f8d4e", "#9e2a2b"};
constexpr const char* kInk = "#30363d";
constexpr double kGap = 0.8;  // between groups, in bars

// Text between double quotes of a gnuplot script.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

// Two digits, more before the point: 12, 1.2, 0.12.
std::string value_text(double value) {
  const int decimals = value >= 10 ? 0 : value >= 1 ? 1 : value >= 0.1 ? 2 : 3;
  return fmt::format("{:.{}f}", value, decimals);
}

// A row for each group: label, then value and text of each series.
std::string data_block(const BarChart& chart) {
  std::string out = "$data << end_of_data\n";
  for (std::size_t group = 0; group < chart.labels.size(); ++group) {
    out += quoted(chart.labels[group]);
    for (const BarChart::Series& series : chart.series)
      out += fmt::format(" {} {}", series.values[group], value_text(series.values[group]));
    out += '\n';
  }
  return out + "end_of_data\n";
}

// Bars, over each its value, and below each group its label: points without a mark, as an axis takes labels from a plot
// only.
std::string plot_line(const BarChart& chart) {
  const double width = 1 / (static_cast<double>(chart.series.size()) + kGap);
  std::string text = "plot $data using 0:2:xtic(1) with dots linecolor rgb 'white' notitle";
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    const double shift = width * (static_cast<double>(k) - (static_cast<double>(chart.series.size()) - 1) / 2);
    const std::size_t column = 2 + 2 * k;
    text += fmt::format(", $data using ($0+{}):{}:({}) with boxes linecolor rgb '{}' title {}", shift, column,
                        0.94 * width, kColors[k % kColors.size()], quoted(chart.series[k].name));
    text += fmt::format(", $data using ($0+{}):{}:{} with labels offset 0,0.55 font ',11' textcolor rgb '{}' notitle",
                        shift, column, column + 1, kInk);
  }
  return text + "\n";
}

// From the decade below the least value to some room over the largest, for its text and the key.
std::string y_range(const BarChart& chart) {
  double least = 1e300, largest = 0;
  for (const BarChart::Series& series : chart.series)
    for (const double value : series.values) least = std::min(least, value), largest = std::max(largest, value);
  if (!chart.log_scale) return fmt::format("set yrange [0:{}]\n", 1.15 * largest);
  return fmt::format("set logscale y\nset format y '%g'\nset yrange [{}:{}]\n",
                     std::pow(10, std::floor(std::log10(least))), 3 * largest);
}

// What both kinds of chart start with.
std::string page(const std::string& title, const std::string& y_label, const std::string& path) {
  std::string out = "set terminal pngcairo size 1200,640 font 'DejaVu Sans,13' background rgb 'white'\n";
  out += "set encoding utf8\nset output " + quoted(path) + "\n";
  out += fmt::format("set title {} textcolor rgb '{}' font ',16' noenhanced\n", quoted(title), kInk);
  out += fmt::format("set ylabel {} textcolor rgb '{}' noenhanced\n", quoted(y_label), kInk);
  out += fmt::format("set border 3 linecolor rgb '{}'\nset tics nomirror textcolor rgb '{}'\n", kInk, kInk);
  return out + "set grid ytics linecolor rgb '#d8dde3' linetype 1\n";
}

std::string script(const BarChart& chart, const std::string& path) {
  std::string out = page(chart.title, chart.y_label, path) + "set xtics scale 0\n";
  out += fmt::format("set key top right textcolor rgb '{}' noenhanced\n", kInk);
  out += "set style fill solid 1 noborder\n";
  out += fmt::format("set xrange [-0.5:{}]\n", static_cast<double>(chart.labels.size()) - 0.5);
  return out + y_range(chart) + data_block(chart) + plot_line(chart);
}

std::string script(const LineChart& chart, const std::string& path) {
  std::string out = page(chart.title, chart.y_label, path);
  out += fmt::format("set xlabel {} textcolor rgb '{}' noenhanced\n", quoted(chart.x_label), kInk);
  out += fmt::format("set key top left textcolor rgb '{}' noenhanced\n", kInk);
  out += "set logscale xy\nset format x '%g'\nset format y '%g'\n";
  std::string plot;
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    const LineChart::Series& series = chart.series[k];
    out += fmt::format("$data{} << end_of_data\n", k);
    for (std::size_t point = 0; point < series.x.size(); ++point)
      out += fmt::format("{} {}\n", series.x[point], series.y[point]);
    out += "end_of_data\n";
    plot += fmt::format("{} $data{} using 1:2 with linespoints linewidth 2 pointtype 7 linecolor rgb '{}' title {}",
                        k == 0 ? "plot" : ",", k, kColors[k % kColors.size()], quoted(series.name));
  }
  return out + plot + "\n";
}

tl::unexpected<Errors> failure(const std::string& path, const std::string& problem) {
  Error error;
  error.file = path;
  error.problem = "not drawn: " + problem;
  return fail(std::move(error));
}

// A socket rather than a pipe: a gnuplot that gives up early then is an error of send(), not a signal that ends us.
struct Channel {
  std::array<int, 2> end{-1, -1};
  bool open() { return socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, end.data()) == 0; }
  void close_end(std::size_t k) {
    if (end[k] >= 0) close(end[k]);
    end[k] = -1;
  }
  ~Channel() { close_end(0), close_end(1); }
};

void send_all(int socket, std::string_view text) {
  while (!text.empty()) {
    const ssize_t sent = send(socket, text.data(), text.size(), MSG_NOSIGNAL);
    if (sent <= 0) return;  // gnuplot's exit status tells why
    text.remove_prefix(static_cast<std::size_t>(sent));
  }
}

// Runs gnuplot on `text`: its exit status, or -1 where it could not be started.
int run_gnuplot(const std::string& text) {
  Channel channel;
  if (!channel.open()) return -1;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, channel.end[1], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::string name = "gnuplot";
  const std::array<char*, 2> arguments{name.data(), nullptr};
  pid_t child = 0;
  const int failed = posix_spawnp(&child, name.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return -1;
  channel.close_end(1);
  send_all(channel.end[0], text);
  channel.close_end(0);
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status)) return 1;
  return WEXITSTATUS(status);
}

template <class Chart>
Result<void> draw(const Chart& chart, const std::string& path) {
  auto file = output::AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  const int status = run_gnuplot(script(chart, file->temporary()));
  if (status == 127 || status < 0) return failure(path, "gnuplot is not installed");
  if (status != 0) return failure(path, "gnuplot could not; it needs its pngcairo terminal");
  return file->commit();
}

}  // namespace

Result<void> write_png(const BarChart& chart, const std::string& path) { return draw(chart, path); }
Result<void> write_png(const LineChart& chart, const std::string& path) { return draw(chart, path); }

}  // namespace divot::cli
