#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "viewer/image.h"

namespace divot::viewer {

/// A program that was started. Ends with it.
class Process {
 public:
  /// `arguments`: the program, looked up in PATH, and what it is given. `environment`: NAME=VALUE to set; NAME to
  /// unset. What it prints goes to the file `output`, where that is not empty. Throws when it cannot be started.
  Process(const std::vector<std::string>& arguments, const std::vector<std::string>& environment = {},
          const std::string& folder = ".", const std::string& output = {});
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Exit status; -1 when it was ended by a signal or did not end within `seconds`.
  int wait(double seconds);
  bool running();
  pid_t id() const { return id_; }

 private:
  pid_t id_ = -1;
  bool reaped_ = false;
  int status_ = -1;
};

/// An X server without a screen (Xvfb). Throws, saying which package is missing, when it cannot be started.
class TestDisplay {
 public:
  TestDisplay();

  const std::string& name() const { return name_; }  ///< as DISPLAY names it

 private:
  std::string log_, name_;
  std::unique_ptr<Process> server_;
};

/// `divot view` in a window on a display, in a folder of its own, with hands on mouse and keyboard.
class ViewSession {
 public:
  /// Opens `scene` (TOML). Throws when no window appears.
  ViewSession(const TestDisplay& display, const std::string& scene, const std::vector<std::string>& options = {});
  ~ViewSession();

  void press(const std::string& key);  ///< as xdotool calls it
  void click(int x, int y);            ///< left button; pixels from the upper left corner
  void drag(int x, int y, int to_x, int to_y, int button);
  void scroll(int notches);  ///< towards the ground where positive
  void resize(int width, int height);
  void close();  ///< as a window manager does
  /// Saves a picture, and returns it.
  Image picture();
  /// Saves the state, and returns its `summary.json`.
  std::string summary();
  Process& process() { return *process_; }

 private:
  void wait_until_it_listens();
  void tool(std::vector<std::string> arguments);
  std::filesystem::path wait_for(const std::string& name);

  const TestDisplay& display_;
  std::filesystem::path folder_;
  std::unique_ptr<Process> process_;
  std::string window_;  // id
  int pictures_ = 0, states_ = 0;
};

/// Lets time pass, s.
void sleep(double seconds);

}  // namespace divot::viewer
