#include "cli/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

// The only file that includes it: it takes seconds to compile.
#include <CLI/CLI.hpp>

namespace divot::cli {
namespace {

constexpr int kMostThreads = 1024;

constexpr const char* kFooter =
    "Exit status: 0 done, 1 the run failed, 2 bad usage or bad input.\n"
    "divot COMMAND --help says more of a command.";

// `bodies.0.mass=500` in two. The value may hold `=` itself.
Override split_override(const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0)
    throw CLI::ValidationError("--set", fmt::format("\"{}\" is not key=value, as in solver.blast=paper", text));
  return {text.substr(0, at), text.substr(at + 1)};
}

CLI::Option* add_scene(CLI::App& command, SceneOptions& scene) {
  CLI::Option* path = command.add_option("SCENE", scene.path, "scene file (TOML)")->required()->type_name("");
  command
      .add_option_function<std::vector<std::string>>(
          "--set",
          [&scene](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) scene.overrides.push_back(split_override(text));
          },
          "change a key of the scene, as bodies.0.mass=500; may be repeated")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  return path;
}

void add_threads(CLI::App& command, SceneOptions& scene) {
  command.add_option("--threads", scene.threads, "worker threads; results do not depend on it (default: all cores)")
      ->check(CLI::Range(1, kMostThreads).description(""))
      ->type_name("N");
}

CLI::Option* add_out(CLI::App& command, std::string& out, const char* what) {
  return command.add_option("--out", out, what)->type_name("DIR");
}

double above_zero(const char* option, double number) {
  if (!(number > 0)) throw CLI::ValidationError(option, fmt::format("{:g} is not above 0", number));
  return number;
}

void add_run(CLI::App& app, RunOptions& options) {
  CLI::App& command = *app.add_subcommand("run", "Simulate a scene and write what came of it");
  CLI::Option* scene = add_scene(command, options.scene)->required(false);
  add_out(command, options.out, "folder for results (default: out/NAME, or that of the checkpoint)");
  command.add_option("--duration", options.scene.duration, "simulated time instead of the scene's, s")->type_name("S");
  add_threads(command, options.scene);
  command
      .add_option_function<double>(
          "--checkpoint-every",
          [&options](double every) { options.checkpoint_every = above_zero("--checkpoint-every", every); },
          "put the run aside as checkpoint.divot each so many simulated seconds")
      ->type_name("S");
  const CLI::Option* resume = command
                                  .add_option("--resume", options.resume,
                                              "go on from a checkpoint; SCENE only where the scene's file has moved")
                                  ->type_name("FILE");
  const CLI::Option* replay =
      command
          .add_option("--replay", options.replay,
                      "do again what was done in a live session; SCENE only where the scene's file has moved")
          ->type_name("FILE");
  command.parse_complete_callback([scene, resume, replay] {
    if (scene->empty() && resume->empty() && replay->empty()) throw CLI::RequiredError("SCENE");
  });
  command.add_flag("--report", options.report,
                   "also write report.html: the run to look at in a browser, without network");
  command.add_flag("--quiet", options.quiet, "print nothing but errors");
}

void add_check(CLI::App& app, CheckOptions& options) {
  CLI::App& command = *app.add_subcommand("check", "Read a scene and its files, and say everything that is wrong");
  add_scene(command, options.scene);
}

void add_materials(CLI::App& app, MaterialsOptions& options) {
  CLI::App& command = *app.add_subcommand("materials", "List the soils that scenes can build on");
  command.add_flag("--json", options.json, "as JSON");
}

void read_size(const std::string& text, int& width, int& height) {
  const std::size_t at = text.find('x');
  const bool read = at != std::string::npos && CLI::detail::lexical_cast(text.substr(0, at), width) &&
                    CLI::detail::lexical_cast(text.substr(at + 1), height);
  if (!read) throw CLI::ValidationError("--size", fmt::format("\"{}\" is not WIDTHxHEIGHT, as in 1280x720", text));
}

void add_size(CLI::App& command, int& width, int& height) {
  command
      .add_option_function<std::string>(
          "--size", [&width, &height](const std::string& text) { read_size(text, width, height); },
          "pixels (default: 1280x720)")
      ->type_name("WIDTHxHEIGHT");
}

// Numbers between commas; `right` says what they are, with an example.
std::vector<double> read_numbers(const std::string& option, const std::string& text, const char* right) {
  std::vector<double> numbers;
  for (const std::string& word : CLI::detail::split(text, ',')) {
    numbers.emplace_back();
    if (!CLI::detail::lexical_cast(word, numbers.back()))
      throw CLI::ValidationError(option, fmt::format("\"{}\" is not {}", text, right));
  }
  return numbers;
}

CLI::Option* add_times(CLI::App& command, const std::string& name, std::vector<double>& times, const char* what) {
  return command
      .add_option_function<std::string>(
          name,
          [name, &times](const std::string& text) {
            times = read_numbers(name, text, "a list of times, as in 0,1.5,3");
          },
          what)
      ->type_name("S,...");
}

viewer::Camera read_camera(const std::string& text) {
  constexpr const char* kRight = "X,Y,Z,TX,TY,TZ or X,Y,Z,TX,TY,TZ,FOV, as in 0,-80,40,0,0,0";
  const std::vector<double> n = read_numbers("--camera", text, kRight);
  if (n.size() != 6 && n.size() != 7)
    throw CLI::ValidationError("--camera", fmt::format("\"{}\" is not {}", text, kRight));
  viewer::Camera camera{.eye = {n[0], n[1], n[2]}, .target = {n[3], n[4], n[5]}};
  if (n.size() == 7) camera.fov_deg = n[6];
  return camera;
}

void add_color(CLI::App& command, viewer::ColorBy& color) {
  const std::vector<std::string> names(viewer::kColorByNames.begin(), viewer::kColorByNames.end());
  command
      .add_option_function<std::string>(
          "--color",
          [names, &color](const std::string& name) {
            color = static_cast<viewer::ColorBy>(std::find(names.begin(), names.end(), name) - names.begin());
          },
          fmt::format("what the ground's colours tell: {} (default: {})", fmt::join(names, ", "), names.front()))
      ->check(CLI::IsMember(names).description(""))
      ->type_name("NAME");
}

void add_view_point(CLI::App& command, RenderOptions& options) {
  command
      .add_option_function<std::string>(
          "--camera", [&options](const std::string& text) { options.camera = read_camera(text); },
          "eye and target in the terrain's coordinates, m, and vertical field of view, degrees (default: frames what "
          "happens, 32 degrees)")
      ->type_name("X,Y,Z,TX,TY,TZ[,FOV]");
  command.add_option("--follow", options.follow, "the camera moves along with this body")->type_name("BODY");
}

void add_render(CLI::App& app, RenderOptions& options) {
  CLI::App& command = *app.add_subcommand("render", "Simulate a scene and draw it, without a display");
  add_scene(command, options.scene);
  add_out(command, options.out, "folder for pictures (default: out/NAME)");
  CLI::Option* at =
      add_times(command, "--at", options.at, "simulated times, s, as 0,1.5,3 (default: five from start to end)");
  add_size(command, options.width, options.height);
  add_view_point(command, options);
  CLI::Option* wireframe = command.add_flag("--wireframe", options.wireframe, "hidden lines instead of lit ground");
  CLI::Option* some = add_times(command, "--wireframe-at", options.wireframe_at, "the same, only for these times");
  add_color(command, options.color);
  CLI::Option* sheet = command.add_flag("--sheet", options.sheet, "also all pictures on one sheet, each with its time");
  CLI::Option* fps = command.add_option_function<double>(
      "--fps", [&options](double rate) { options.fps = above_zero("--fps", rate); },
      "numbered pictures over the whole run, so many a second");
  fps->type_name("N");
  CLI::Option* video =
      command.add_option("--video", options.video,
                         "also a video of them inside DIR (.mp4, .mkv or .mov), where ffmpeg is installed; 30 a second "
                         "without --fps");
  video->type_name("FILE");
  some->excludes(wireframe);
  for (CLI::Option* series : {fps, video})
    for (CLI::Option* single : {at, some, sheet}) series->excludes(single);
  add_threads(command, options.scene);
}

void add_view(CLI::App& app, ViewOptions& options) {
  CLI::App& command = *app.add_subcommand("view", "Run a scene live in a window; h shows what keys and mouse do");
  add_scene(command, options.scene);
  add_size(command, options.width, options.height);
  command.add_option("--quality", options.quality, "fast, fine or auto: as fine as the machine can (default: auto)")
      ->check(CLI::IsMember({"auto", "fast", "fine"}).description(""))
      ->type_name("NAME");
  add_threads(command, options.scene);
  command
      .add_option("--record", options.record,
                  "keep what is done in the window, for divot run --replay; a restart begins anew")
      ->type_name("FILE");
}

void add_bench(CLI::App& app, BenchOptions& options) {
  CLI::App& command = *app.add_subcommand("bench", "Measure how long the parts of a step take");
  command.add_option("NAME", options.names, "benchmarks (default: all)")->type_name("");
  command.add_option("--json", options.json, "file for the numbers")->type_name("FILE");
  add_out(command, options.out, "folder for plots (default: out/bench)");
  command.add_option("--scenes", options.scenes, "folder of the scene files")->type_name("DIR");
  command.add_option("--most", options.most, "leave out cases with more particles, vertices or bodies than this")
      ->type_name("N");
}

void add_validate(CLI::App& app, ValidateOptions& options) {
  CLI::App& command = *app.add_subcommand("validate", "Compare simulations with what was measured or published");
  command.add_option("NAME", options.names, "families of cases, or cases (default: all)")->type_name("");
  command.add_option("--json", options.json, "file for the comparisons")->type_name("FILE");
  CLI::Option* out = add_out(command, options.out, "folder for plots (default: out/validate)");
  command.add_option("--docs", options.docs, "also writes validation.md, with its plots, into this folder")
      ->type_name("DIR")
      ->excludes(out);
  command.add_flag("--list", options.list, "say what would be compared, and run nothing");
  command.add_option("--scenes", options.scenes, "folder of the scene files")->type_name("DIR");
  command.add_option("--data", options.data, "folder of the measured data")->type_name("DIR");
  command.add_option("--threads", options.threads, "comparisons made at a time (default: all cores)")
      ->check(CLI::Range(1, kMostThreads).description(""))
      ->type_name("N");
}

// CLI11 says "--duration: 1 required TEXT missing" and the like; ours ends with where to find help.
int complain(const CLI::App& app, const CLI::ParseError& error) {
  std::string command = "divot";
  for (const CLI::App* used : app.get_subcommands()) command += " " + used->get_name();
  fmt::print(stderr, "{}: {} (see {} --help)\n", command, error.what(), command);
  return kBadInput;
}

}  // namespace

tl::expected<Command, int> parse(int argc, char** argv) {
  CLI::App app("divot deforms terrain physically: what rolls over it leaves ruts, bombs leave craters.", "divot");
  app.footer(kFooter);
  app.set_version_flag("--version", "divot " DIVOT_VERSION);
  app.require_subcommand(0, 1);
  RunOptions run;
  CheckOptions check;
  MaterialsOptions materials;
  RenderOptions render;
  ViewOptions view;
  BenchOptions bench;
  ValidateOptions validate;
  add_run(app, run);
  add_check(app, check);
  add_materials(app, materials);
  add_render(app, render);
  add_view(app, view);
  add_bench(app, bench);
  add_validate(app, validate);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return tl::unexpected(app.exit(help_or_version));
  } catch (const CLI::ParseError& error) {
    return tl::unexpected(complain(app, error));
  }
  if (app.got_subcommand("run")) return run;
  if (app.got_subcommand("check")) return check;
  if (app.got_subcommand("materials")) return materials;
  if (app.got_subcommand("render")) return render;
  if (app.got_subcommand("view")) return view;
  if (app.got_subcommand("bench")) return bench;
  if (app.got_subcommand("validate")) return validate;
  fmt::print(stderr, "{}", app.help());
  return tl::unexpected(kBadInput);
}

}  // namespace divot::cli
