#pragma once

#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <variant>
#include <vector>

#include "divot/scene.h"
#include "viewer/camera.h"
#include "viewer/look.h"

namespace divot::cli {

/// Exit status of the program.
inline constexpr int kDone = 0, kFailed = 1, kBadInput = 2;

/// A scene file and how it is changed from the command line.
struct SceneOptions {
  std::string path;
  std::vector<Override> overrides;  ///< of --set, in order
  std::string duration;             ///< of --duration, as it was typed; empty: the scene's
  int threads = 0;                  ///< 0: one for each core
};

struct RunOptions {
  SceneOptions scene;
  std::string out;              ///< folder for results; empty: out/NAME
  std::string replay;           ///< recording of a live session to carry out; empty: none
  std::string resume;           ///< checkpoint to go on from; empty: from the start
  double checkpoint_every = 0;  ///< s of simulated time; 0: never
  bool report = false;          ///< also report.html
  bool quiet = false;
};

struct CheckOptions {
  SceneOptions scene;
};

struct MaterialsOptions {
  bool json = false;
};

struct RenderOptions {
  SceneOptions scene;
  std::string out;         ///< folder for pictures; empty: out/NAME
  std::vector<double> at;  ///< s; empty: the start and four times evenly spaced to the end
  int width = 1280, height = 720;
  bool wireframe = false;
  std::vector<double> wireframe_at;  ///< s, some of the pictures' times: only these are lines
  viewer::ColorBy color = viewer::ColorBy::natural;
  std::optional<viewer::Camera> camera;  ///< empty: frames what happens
  std::string follow;                    ///< name of the body that the camera moves along with; empty: none
  double fps = 0;                        ///< pictures a second over the whole run; 0: single pictures
  std::string video;                     ///< file inside the folder, made of the pictures at `fps`; empty: none
  bool sheet = false;                    ///< also all pictures on one sheet, each with its time
};

struct ViewOptions {
  SceneOptions scene;
  int width = 1280, height = 720;  ///< of the window, pixels
  std::string quality = "auto";    ///< auto, fast or fine
  std::string record;              ///< file for a recording of the session; empty: none
};

struct BenchOptions {
  std::vector<std::string> names;  ///< empty: all
  std::string json;                ///< file for results; empty: none
  std::string out;                 ///< folder for plots
  std::string scenes;              ///< folder of the scene files
  std::size_t most = 2'000'000;    ///< cases with more particles, vertices or bodies are left out
};

struct ValidateOptions {
  std::vector<std::string> names;  ///< families or cases; empty: all
  std::string json;                ///< file for results; empty: none
  std::string out;                 ///< folder for plots
  std::string docs;                ///< folder for validation.md and its plots; empty: not written
  std::string scenes, data;        ///< folders of scene files and of measured data
  int threads = 0;                 ///< 0: one for each core
  bool list = false;
};

/// What the command line asks for.
using Command =
    std::variant<RunOptions, CheckOptions, MaterialsOptions, RenderOptions, ViewOptions, BenchOptions, ValidateOptions>;

/// Reads the command line. When there is nothing left to do (help, version, bad usage) it has said so and the error is
/// the exit status.
tl::expected<Command, int> parse(int argc, char** argv);

}  // namespace divot::cli
