#include "viewer/test_display.h"

#include <X11/Xlib.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <osgDB/ReadFile>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace divot::viewer {
namespace {

constexpr double kPatience = 30;  // s, on a busy machine
constexpr double kPoll = 0.05;    // s

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// Asks until the answer is not empty.
template <class Ask>
std::string insist(const Ask& ask, const std::string& what) {
  for (double waited = 0; waited < kPatience; waited += kPoll) {
    if (const std::string answer = ask(); !answer.empty()) return answer;
    sleep(kPoll);
  }
  throw std::runtime_error(what);
}

void set_environment(const std::vector<std::string>& environment) {
  for (const std::string& entry : environment) {
    const std::size_t at = entry.find('=');
    if (at == std::string::npos) {
      unsetenv(entry.c_str());
    } else {
      setenv(entry.substr(0, at).c_str(), entry.substr(at + 1).c_str(), 1);
    }
  }
}

[[noreturn]] void become(const std::vector<std::string>& arguments, const std::string& folder,
                         const std::string& output) {
  if (!output.empty()) {
    const int file = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
  }
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  if (chdir(folder.c_str()) == 0) execvp(argv[0], argv.data());
  _exit(127);
}

}  // namespace

void sleep(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

Process::Process(const std::vector<std::string>& arguments, const std::vector<std::string>& environment,
                 const std::string& folder, const std::string& output)
    : id_(fork()) {
  if (id_ < 0) throw std::runtime_error("no process for " + arguments.front());
  if (id_ > 0) return;
  set_environment(environment);
  become(arguments, folder, output);
}

Process::~Process() {
  if (!running()) return;
  kill(id_, SIGTERM);
  if (wait(5) != -1 || reaped_) return;
  kill(id_, SIGKILL);
  waitpid(id_, nullptr, 0);
}

bool Process::running() {
  int status = 0;
  if (!reaped_ && waitpid(id_, &status, WNOHANG) == id_) {
    reaped_ = true;
    status_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  return !reaped_;
}

int Process::wait(double seconds) {
  for (double waited = 0; running() && waited < seconds; waited += kPoll) sleep(kPoll);
  return status_;
}

TestDisplay::TestDisplay() : log_(std::filesystem::temp_directory_path() / fmt::format("divot_display_{}", getpid())) {
  // The server chooses a free number and prints it. Without -noreset it would begin anew, and drop who connects just
  // then, whenever its last client leaves, as xdotool does after each call.
  const std::vector<std::string> command = {"Xvfb", "-displayfd", "1",   "-screen", "0", "1000x800x24", "+extension",
                                            "GLX",  "-nolisten",  "tcp", "-noreset"};
  server_ = std::make_unique<Process>(command, std::vector<std::string>{}, ".", log_);
  const std::string number = insist(
      [&]() -> std::string {
        if (!server_->running()) {
          throw std::runtime_error(
              "Xvfb cannot be started: tests of the window need the packages xvfb and xdotool "
              "(script/bootstrap --test installs them)");
        }
        std::istringstream lines(read(log_));
        for (std::string line; std::getline(lines, line);) {
          if (!line.empty() && std::all_of(line.begin(), line.end(), [](unsigned char c) { return std::isdigit(c); })) {
            return line;
          }
        }
        return {};
      },
      "Xvfb does not say its display");
  name_ = ":" + number;
  std::filesystem::remove(log_);
}

ViewSession::ViewSession(const TestDisplay& display, const std::string& scene, const std::vector<std::string>& options)
    : display_(display), folder_(std::filesystem::temp_directory_path() / fmt::format("divot_view_{}", getpid())) {
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directory(folder_);
  std::ofstream(folder_ / "test.toml") << scene;
  std::vector<std::string> command = {DIVOT_PROGRAM, "view", "test.toml", "--size", "640x400"};
  command.insert(command.end(), options.begin(), options.end());
  process_ = std::make_unique<Process>(command, std::vector{"DISPLAY=" + display.name()}, folder_, folder_ / "log");
  const std::string found = folder_ / "window";
  window_ = insist(
      [&]() -> std::string {
        if (!process_->running()) throw std::runtime_error("divot view ended: " + read(folder_ / "log"));
        Process search({"xdotool", "search", "--name", "divot: test"}, {"DISPLAY=" + display_.name()}, ".", found);
        if (search.wait(kPatience) == 127) {
          throw std::runtime_error(
              "tests of the window need the package xdotool (script/bootstrap --test installs it)");
        }
        const std::string ids = read(found);
        return ids.substr(0, ids.find('\n'));
      },
      "no window appears");
  // Keys go where the mouse is, as no window manager says otherwise.
  tool({"mousemove", "320", "200"});
  wait_until_it_listens();
}

// What is typed before a window's first picture is lost.
void ViewSession::wait_until_it_listens() {
  insist(
      [&]() -> std::string {
        press("x");
        sleep(0.5);
        return exists(folder_ / "test_001.png") ? "listens" : "";
      },
      "the window does not listen to keys");
  // Late pictures are waited for until none has come for a while, then all are counted.
  for (int before = -1; before != pictures_;) {
    before = pictures_;
    sleep(1.5);
    while (exists(folder_ / fmt::format("test_{:03}.png", pictures_ + 1))) ++pictures_;
  }
}

ViewSession::~ViewSession() {
  process_.reset();
  std::filesystem::remove_all(folder_);
}

void ViewSession::tool(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "xdotool");
  Process process(arguments, {"DISPLAY=" + display_.name()});
  if (process.wait(kPatience) != 0) throw std::runtime_error("xdotool failed: " + fmt::format("{}", arguments[1]));
}

void ViewSession::press(const std::string& key) { tool({"key", key}); }

void ViewSession::click(int x, int y) {
  tool({"mousemove", std::to_string(x), std::to_string(y)});
  tool({"click", "1"});
}

void ViewSession::drag(int x, int y, int to_x, int to_y, int button) {
  tool({"mousemove", std::to_string(x), std::to_string(y)});
  tool({"mousedown", std::to_string(button)});
  tool({"mousemove", std::to_string((x + to_x) / 2), std::to_string((y + to_y) / 2)});
  tool({"mousemove", std::to_string(to_x), std::to_string(to_y)});
  tool({"mouseup", std::to_string(button)});
}

void ViewSession::scroll(int notches) {
  for (int i = 0; i < std::abs(notches); ++i) tool({"click", notches > 0 ? "4" : "5"});
}

void ViewSession::resize(int width, int height) {
  tool({"windowsize", window_, std::to_string(width), std::to_string(height)});
}

void ViewSession::close() {
  ::Display* display = XOpenDisplay(display_.name().c_str());
  XEvent event = {};
  event.xclient.type = ClientMessage;
  event.xclient.window = std::stoul(window_);
  event.xclient.message_type = XInternAtom(display, "WM_PROTOCOLS", False);
  event.xclient.format = 32;
  event.xclient.data.l[0] = static_cast<long>(XInternAtom(display, "WM_DELETE_WINDOW", False));
  XSendEvent(display, event.xclient.window, False, NoEventMask, &event);
  XCloseDisplay(display);
}

std::filesystem::path ViewSession::wait_for(const std::string& name) {
  return insist([&] { return exists(folder_ / name) ? (folder_ / name).string() : std::string(); },
                name + " does not appear");
}

Image ViewSession::picture() {
  press("x");
  const auto path = wait_for(fmt::format("test_{:03}.png", ++pictures_));
  const osg::ref_ptr<osg::Image> read = osgDB::readRefImageFile(path.string());
  Image image{.width = read->s(), .height = read->t()};
  for (int row = 0; row < image.height; ++row) {
    const unsigned char* source = read->data(0, static_cast<unsigned>(image.height - 1 - row));
    image.rgb.insert(image.rgb.end(), source, source + 3 * image.width);
  }
  return image;
}

std::string ViewSession::summary() {
  press("k");
  return read(wait_for(fmt::format("test_state_{:03}/summary.json", ++states_)));
}

}  // namespace divot::viewer
