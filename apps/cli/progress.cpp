#include "cli/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace divot::cli {
namespace {

using namespace std::chrono_literals;

constexpr int kUsualWidth = 80, kLongestBar = 40, kShortestBar = 8;

int terminal_width() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : kUsualWidth;
}

// `8 s`, `3:05 min`, `2:10 h`
std::string span_of_time(double seconds) {
  const auto s = static_cast<long>(std::ceil(std::min(seconds, 1e9)));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{}:{:02} min", s / 60, s % 60);
  return fmt::format("{}:{:02} h", s / 3600, s / 60 % 60);
}

}  // namespace

std::string factor_text(double factor) {
  const int decimals = factor < 10 ? 2 : factor < 100 ? 1 : 0;
  return fmt::format("{:.{}f}", factor, decimals);
}

std::string progress_line(double simulated, double total, double elapsed, int width) {
  const double share = std::clamp(simulated / total, 0.0, 1.0);
  std::string text = fmt::format("{:.2f} of {:g} s", simulated, total);
  if (elapsed > 0 && simulated > 0)
    text += fmt::format(", {} x real time, {} left", factor_text(simulated / elapsed),
                        span_of_time(elapsed * (1 / share - 1)));
  const auto room = static_cast<std::size_t>(std::max(width, 0));
  if (text.size() > room) return text.substr(0, room);
  // Brackets and a blank around the bar.
  const int bar = std::min(kLongestBar, width - static_cast<int>(text.size()) - 3);
  if (bar < kShortestBar) return text;
  const auto done = static_cast<std::size_t>(std::lround(share * bar));
  return fmt::format("[{:<{}}] {}", std::string(done, '#'), bar, text);
}

Progress::Progress(double total, bool wanted) : total_(total), shown_(wanted && isatty(STDERR_FILENO) == 1) {}

void Progress::update(double simulated) {
  if (!shown_) return;
  const Clock::time_point now = Clock::now();
  if (now - last_ < 100ms) return;
  last_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  // The last column stays free: some terminals wrap as soon as it is written to.
  fmt::print(stderr, "\r\x1b[K{}", progress_line(simulated, total_, elapsed, terminal_width() - 1));
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::clear() {
  if (!drawn_) return;
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace divot::cli
