#include "cli/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <string_view>

#include "output/atomic_file.h"

extern char** environ;

namespace divot::cli::gnuplot {
namespace {

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

}  // namespace

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string opening(const std::string& path, int width, int height, const Titles& titles) {
  std::string out = fmt::format(
      "set terminal pngcairo size {},{} font 'DejaVu Sans,13' background rgb 'white'\n"
      "set encoding utf8\nset output {}\n",
      width, height, quoted(path));
  out += fmt::format("set title {} textcolor rgb '{}' font ',16' noenhanced\n", quoted(titles.title), kInk);
  if (!titles.x_label.empty())
    out += fmt::format("set xlabel {} textcolor rgb '{}' noenhanced\n", quoted(titles.x_label), kInk);
  if (!titles.y_label.empty())
    out += fmt::format("set ylabel {} textcolor rgb '{}' noenhanced\n", quoted(titles.y_label), kInk);
  out += fmt::format("set border 3 linecolor rgb '{}'\nset tics nomirror textcolor rgb '{}'\n", kInk, kInk);
  return out + fmt::format("set key textcolor rgb '{}' noenhanced\n", kInk);
}

Result<void> draw(const std::string& path, const std::function<std::string(const std::string&)>& script) {
  auto file = output::AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  const int status = run_gnuplot(script(file->temporary()));
  if (status == 127 || status < 0) return failure(path, "gnuplot is not installed");
  if (status != 0) return failure(path, "gnuplot could not; it needs its pngcairo terminal");
  return file->commit();
}

}  // namespace divot::cli::gnuplot
