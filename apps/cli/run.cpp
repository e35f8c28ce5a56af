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
    next_ = std::floor((time + tolerance_) / every_) + 1;
    return true;
  }

 private:
  double every_, tolerance_, next_ = 0;
};

// A world on its way to the end, with what it writes as it goes.
class Run {
 public:
  Run(World& world, Recorder& recorder, Report* report)
      : world_(world),
        recorder_(recorder),
        report_(report),
        frames_(world.scene().output.every, world.scene().dt),
        bodies_(world.scene().output.every > 0 ? world.scene().output.every : kBodiesEvery, world.scene().dt),
        report_times_(world.scene().duration / kReportTimes, world.scene().dt) {}

  Result<RunTotals> go(bool show_progress);

 private:
  Result<void> record();
  void step();

  World& world_;
  Recorder& recorder_;
  Report* report_;  // null: none
  Rhythm frames_, bodies_, report_times_;
  bool has_row_ = false;  // bodies.csv holds the bodies as they are now
  RunTotals totals_;
};

Result<void> Run::record() {
  has_row_ = bodies_.is_due(world_.time());
  if (has_row_) recorder_.add_bodies(world_);
  if (report_ != nullptr && report_times_.is_due(world_.time())) report_->add(world_);
  if (frames_.is_due(world_.time())) return recorder_.write_frame(world_);
  return {};
}

void Run::step() {
  const StepReport report = world_.step();
  totals_.substeps_limited += report.substeps_limited;
  totals_.not_finite += report.not_finite;
}

Result<RunTotals> Run::go(bool show_progress) {
  const std::uint64_t steps = step_count(world_.scene());
  Progress progress(world_.scene().duration, show_progress);
  const auto start = std::chrono::steady_clock::now();
  if (const auto written = record(); !written) return tl::unexpected(written.error());
  while (world_.steps() < steps && !interrupted()) {
    step();
    if (const auto written = record(); !written) return tl::unexpected(written.error());
    progress.update(world_.time());
  }
  if (!has_row_) recorder_.add_bodies(world_);
  totals_.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  totals_.interrupted = world_.steps() < steps;
  return totals_;
}

}  // namespace

int run(const RunOptions& options) {
  auto world = open_world(options.scene);
  if (!world) return report(world.error(), kBadInput);
  catch_interrupts();
  const std::string folder = results_folder(options.out, world->scene());
  auto recorder = Recorder::create(folder);
  if (!recorder) return report(recorder.error(), kFailed);

  Report page(options.report ? scene_text(options.scene) : std::string());
  const auto totals = Run(*world, *recorder, options.report ? &page : nullptr).go(!options.quiet);
  if (!totals) return report(totals.error(), kFailed);
  if (options.report) {
    const std::string path = (std::filesystem::path(folder) / "report.html").string();
    if (const auto written = page.write(path, *world, *totals); !written) return report(written.error(), kFailed);
  }
  if (const auto written = recorder->finish(*world, *totals); !written) return report(written.error(), kFailed);
  if (!options.quiet) fmt::print("{}", run_summary(*world, *totals, folder));
  if (!totals->interrupted) return kDone;
  fmt::print(stderr, "interrupted at {:.2f} of {:g} s; the results are those of the time reached\n", world->time(),
             world->scene().duration);
  return kFailed;
}

}  // namespace divot::cli
