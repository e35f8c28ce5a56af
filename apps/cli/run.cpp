#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/run_summary.h"
#include "cli/scene_input.h"
#include "divot/output.h"
#include "divot/recording.h"

namespace divot::cli {
namespace {

// Times that a report shows, spread over the run.
constexpr double kReportTimes = 200;

// Rows of bodies.csv where the scene asks for no frames, s.
constexpr double kBodiesEvery = 0.1;

// What happens every so many seconds, at the step nearest, beginning with the start. 0: never.
class Rhythm {
 public:
  Rhythm(double every, double dt) : every_(every), tolerance_(0.5 * dt) {}
  bool is_due(double time) {
    if (every_ <= 0 || time + tolerance_ < next_ * every_) return false;
    skip_to(time);
    return true;
  }
  // What was due until `time` has been done.
  void skip_to(double time) { next_ = std::floor((time + tolerance_) / every_) + 1; }

 private:
  double every_, tolerance_, next_ = 0;
};

// A run from its start or from where it was put aside.
struct Begun {
  World world;
  Recorder recorder;
  SceneFile scene;
  std::vector<divot::Command> commands;  // of a live session, to be carried out at their steps
  RunTotals totals;
  std::string folder;
  bool resumed = false;
};

// A world on its way to the end, with what it writes as it goes.
class Run {
 public:
  Run(Begun& begun, Report* report, double checkpoint_every)
      : begun_(begun),
        report_(report),
        checkpoint_every_(checkpoint_every),
        frames_(settings().output.every, settings().dt),
        bodies_(settings().output.every > 0 ? settings().output.every : kBodiesEvery, settings().dt),
        report_times_(settings().duration / kReportTimes, settings().dt),
        checkpoints_(checkpoint_every, settings().dt) {
    checkpoints_.skip_to(begun.world.time());
    if (begun.resumed) frames_.skip_to(begun.world.time()), bodies_.skip_to(begun.world.time());
  }

  Result<void> go(bool show_progress);

 private:
  const Scene& settings() const { return begun_.world.scene(); }
  Result<void> record();
  Result<void> put_aside();
  Result<void> step();
  Result<void> carry_out_due();

  Begun& begun_;
  std::size_t next_command_ = 0;
  Report* report_;  // null: none
  double checkpoint_every_;
  Rhythm frames_, bodies_, report_times_, checkpoints_;
  std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
};

Result<void> Run::record() {
  const double time = begun_.world.time();
  if (bodies_.is_due(time)) begun_.recorder.add_bodies(begun_.world);
  if (report_ != nullptr && report_times_.is_due(time)) report_->add(begun_.world);
  if (frames_.is_due(time))
    if (auto written = begun_.recorder.write_frame(begun_.world); !written) return written;
  if (checkpoints_.is_due(time)) return put_aside();
  return {};
}

Result<void> Run::put_aside() {
  const auto now = std::chrono::steady_clock::now();
  begun_.totals.wall_s += std::chrono::duration<double>(now - since_).count();
  since_ = now;
  return begun_.recorder.write_checkpoint(begun_.world, begun_.totals, begun_.scene);
}

// Commands of steps that a resumed run has behind it are in its world.
Result<void> Run::carry_out_due() {
  const std::uint64_t now = begun_.world.steps();
  for (; next_command_ < begun_.commands.size() && begun_.commands[next_command_].step <= now; ++next_command_) {
    if (begun_.commands[next_command_].step < now) continue;
    auto done = begun_.world.carry_out(begun_.commands[next_command_]);
    if (done) continue;
    for (Error& error : done.error()) {
      error.file = begun_.scene.replay;
      error.key = fmt::format("commands[{}].{}", next_command_, error.key);
    }
    return done;
  }
  return {};
}

Result<void> Run::step() {
  if (auto done = carry_out_due(); !done) return done;
  const StepReport report = begun_.world.step();
  begun_.totals.substeps_limited += report.substeps_limited;
  begun_.totals.not_finite += report.not_finite;
  return {};
}

Result<void> Run::go(bool show_progress) {
  const std::uint64_t steps = step_count(settings());
  Progress progress(settings().duration, show_progress);
  if (const auto written = record(); !written) return written;
  while (begun_.world.steps() < steps && !interrupted()) {
    if (const auto stepped = step(); !stepped) return stepped;
    if (const auto written = record(); !written) return written;
    progress.update(begun_.world.time());
  }
  begun_.totals.wall_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - since_).count();
  since_ = std::chrono::steady_clock::now();
  begun_.totals.interrupted = begun_.world.steps() < steps;
  if (begun_.totals.interrupted && checkpoint_every_ > 0) return put_aside();
  return {};
}

// What the command line says of a scene, on top of what is known of it.
SceneOptions on_top(const SceneFile& known, SceneOptions options) {
  if (options.path.empty()) options.path = known.path;
  options.overrides.insert(options.overrides.begin(), known.overrides.begin(), known.overrides.end());
  return options;
}

// A recording is carried out for as long as it lasted, unless the command line says otherwise.
Result<SceneOptions> scene_of(const Recording& recording, const SceneOptions& options) {
  SceneOptions scene = on_top({recording.scene, recording.changes, {}}, options);
  if (!scene.duration.empty()) return scene;
  const auto loaded = load(scene);
  if (!loaded) return tl::unexpected(loaded.error());
  const std::uint64_t steps = std::max<std::uint64_t>(recording.steps, 1);
  scene.overrides.push_back({"duration", fmt::format("{}", static_cast<double>(steps) * loaded->dt)});
  return scene;
}

Result<std::vector<divot::Command>> commands_for(const World& world, const std::string& file, Recording recording) {
  if (recording.fingerprint == 0 || recording.fingerprint == world.scene_fingerprint())
    return std::move(recording.commands);
  return fail({.file = file,
               .key = "fingerprint",
               .problem = "the scene is not the one of the session",
               .expected = "the same scene, or no fingerprint to carry it out on another"});
}

tl::expected<Begun, int> begin(const RunOptions& options) {
  SceneOptions scene = options.scene;
  Recording recording;
  if (!options.replay.empty()) {
    auto read = read_recording(options.replay);
    if (!read) return tl::unexpected(report(read.error(), kBadInput));
    recording = std::move(*read);
    const auto recorded = scene_of(recording, scene);
    if (!recorded) return tl::unexpected(report(recorded.error(), kBadInput));
    scene = *recorded;
  }
  auto world = open_world(scene);
  if (!world) return tl::unexpected(report(world.error(), kBadInput));
  auto commands = commands_for(*world, options.replay, std::move(recording));
  if (!commands) return tl::unexpected(report(commands.error(), kBadInput));
  const std::string folder = results_folder(options.out, world->scene());
  auto recorder = Recorder::create(folder);
  if (!recorder) return tl::unexpected(report(recorder.error(), kFailed));
  return Begun{
      std::move(*world), std::move(*recorder), scene_file(scene, options.replay), std::move(*commands), {}, folder};
}

tl::expected<Begun, int> resume(const RunOptions& options) {
  const auto checkpoint = read_checkpoint(options.resume);
  if (!checkpoint) return tl::unexpected(report(checkpoint.error(), kBadInput));
  const SceneOptions scene = on_top(checkpoint->scene, options.scene);
  const std::string replay = options.replay.empty() ? checkpoint->scene.replay : options.replay;
  auto world = reopen_world(scene, *checkpoint, options.resume);
  if (!world) return tl::unexpected(report(world.error(), kBadInput));
  auto recording = replay.empty() ? Recording{} : read_recording(replay);
  if (!recording) return tl::unexpected(report(recording.error(), kBadInput));
  auto commands = commands_for(*world, replay, std::move(*recording));
  if (!commands) return tl::unexpected(report(commands.error(), kBadInput));
  const std::string beside = std::filesystem::path(options.resume).parent_path().string();
  const std::string folder = !options.out.empty() ? options.out : beside.empty() ? "." : beside;
  auto recorder = Recorder::resume(folder, *checkpoint);
  if (!recorder) return tl::unexpected(report(recorder.error(), kFailed));
  return Begun{std::move(*world),
               std::move(*recorder),
               scene_file(scene, replay),
               std::move(*commands),
               checkpoint->totals,
               folder,
               true};
}

}  // namespace

int run(const RunOptions& options) {
  auto begun = options.resume.empty() ? begin(options) : resume(options);
  if (!begun) return begun.error();
  catch_interrupts();
  const World& world = begun->world;
  const RunTotals& totals = begun->totals;

  Report page(options.report ? scene_text(begun->scene) : std::string());
  const auto went = Run(*begun, options.report ? &page : nullptr, options.checkpoint_every).go(!options.quiet);
  if (!went) return report(went.error(), went.error().front().file == begun->scene.replay ? kBadInput : kFailed);
  if (options.report) {
    const std::string path = (std::filesystem::path(begun->folder) / "report.html").string();
    if (const auto written = page.write(path, world, totals); !written) return report(written.error(), kFailed);
  }
  if (const auto written = begun->recorder.finish(world, totals); !written) return report(written.error(), kFailed);
  if (!options.quiet) fmt::print("{}", run_summary(world, totals, begun->folder));
  if (!totals.interrupted) return kDone;
  fmt::print(stderr, "interrupted at {:.2f} of {:g} s; the results are those of the time reached\n", world.time(),
             world.scene().duration);
  return kFailed;
}

}  // namespace divot::cli
