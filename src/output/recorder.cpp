#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "core/archive.h"
#include "divot/output.h"
#include "output/csv.h"
#include "output/formats.h"
#include "output/json.h"
#include "output/summary.h"
#include "output/writer.h"

namespace divot {
namespace {

using output::Format;
using output::Frame;

// Frames that wait for the disk may take this much memory.
constexpr std::size_t kMostWaiting = std::size_t{512} << 20;

std::vector<const Format*> formats_of(const World& world, std::vector<std::string> always) {
  const std::vector<std::string>& asked = world.scene().output.formats;
  always.insert(always.end(), asked.begin(), asked.end());
  std::vector<const Format*> found;
  for (const std::string& name : always) {
    const Format* format = &output::format(name);
    if (std::ranges::find(found, format) == found.end()) found.push_back(format);
  }
  return found;
}

std::string bodies_path(const std::string& folder) { return (std::filesystem::path(folder) / "bodies.csv").string(); }

// What a recorder leaves to one that goes on in its place.
struct Progress {
  std::string rows;  // of bodies.csv
  std::optional<std::uint64_t> last_row;
  std::uint64_t frames = 0;
  std::vector<std::pair<std::string, std::vector<output::SeriesEntry>>> series;
};

template <class Archive, core::Is<Progress> T>
void archive(Archive& a, T& progress) {
  a(progress.rows, progress.last_row, progress.frames, progress.series);
}

}  // namespace

namespace output {

template <class Archive, core::Is<SeriesEntry> T>
void archive(Archive& a, T& entry) {
  a(entry.file, entry.time);
}

}  // namespace output

struct Recorder::Impl {
  Impl(std::string results_folder, output::BodiesCsv rows)
      : folder(std::move(results_folder)), bodies(std::move(rows)) {}
  ~Impl() {
    if (!finished) static_cast<void>(bodies.salvage());
  }

  std::string path(const std::string& name) const { return (std::filesystem::path(folder) / name).string(); }

  /// Has the writer write the ground in each of `formats` as STEM.FORMAT, and add frames to their series.
  void write(const World& world, const std::string& stem, const std::vector<const Format*>& formats, bool in_series);

  std::string folder;
  output::BodiesCsv bodies;
  std::optional<std::uint64_t> last_row;  // step of the last rows of bodies.csv
  std::uint64_t frames = 0;
  bool finished = false;
  std::shared_ptr<const Frame> last;
  std::map<std::string, std::vector<output::SeriesEntry>> series;  // by format; the writer's own
  output::Writer writer{kMostWaiting};                             // last: it is done before the rest goes
};

void Recorder::Impl::write(const World& world, const std::string& stem, const std::vector<const Format*>& formats,
                           bool in_series) {
  if (formats.empty()) return;
  const bool raster = std::ranges::any_of(formats, [](const Format* f) { return f->raster; });
  last = std::make_shared<const Frame>(output::take_frame(world, last.get(), raster));
  writer.push(last->bytes(), [this, frame = last, stem, formats, in_series]() -> Result<void> {
    for (const Format* format : formats) {
      if (format->raster && !frame->raster) continue;
      const std::string file = fmt::format("{}.{}", stem, format->name);
      if (auto written = format->write(path(file), *frame); !written) return written;
      if (!in_series || format->write_series == nullptr) continue;
      std::vector<output::SeriesEntry>& entries = series[format->name];
      entries.push_back({file, frame->time});
      if (auto written = format->write_series(path(format->series_name), entries); !written) return written;
    }
    return {};
  });
}

Recorder::Recorder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;
Recorder::~Recorder() = default;

Result<Recorder> Recorder::create(const std::string& folder) {
  if (const auto made = output::make_folder(folder); !made) return tl::unexpected(made.error());
  auto bodies = output::BodiesCsv::create(bodies_path(folder));
  if (!bodies) return tl::unexpected(bodies.error());
  return Recorder(std::make_unique<Impl>(folder, std::move(*bodies)));
}

Result<Recorder> Recorder::resume(const std::string& folder, const Checkpoint& checkpoint) {
  Progress progress;
  core::ByteReader reader(checkpoint.files);
  reader(progress);
  if (!reader.ok() || !reader.at_end())
    return fail({.problem = "what a run had written is damaged", .expected = "expected the bytes of a Recorder"});
  if (const auto made = output::make_folder(folder); !made) return tl::unexpected(made.error());
  auto bodies = output::BodiesCsv::create(bodies_path(folder), progress.rows);
  if (!bodies) return tl::unexpected(bodies.error());
  auto impl = std::make_unique<Impl>(folder, std::move(*bodies));
  impl->last_row = progress.last_row;
  impl->frames = progress.frames;
  for (auto& [format, entries] : progress.series) impl->series[format] = std::move(entries);
  return Recorder(std::move(impl));
}

void Recorder::add_bodies(const World& world) {
  impl_->bodies.append(world.time(), world.bodies());
  impl_->last_row = world.steps();
}

Result<void> Recorder::write_frame(const World& world) {
  impl_->write(world, fmt::format("frame_{:06}", impl_->frames), formats_of(world, {}), true);
  ++impl_->frames;
  return impl_->writer.status();
}

Result<void> Recorder::write_checkpoint(const World& world, const RunTotals& totals, const SceneFile& scene) {
  auto rows = impl_->bodies.text();
  if (!rows) return tl::unexpected(rows.error());
  auto progress = std::make_shared<Progress>(Progress{std::move(*rows), impl_->last_row, impl_->frames, {}});
  auto checkpoint = std::make_shared<Checkpoint>(Checkpoint{scene, totals, world.save(), {}});
  const std::size_t bytes = progress->rows.size() + checkpoint->world.size();
  // After the frames so far: what a checkpoint takes as written is there.
  impl_->writer.push(bytes, [impl = impl_.get(), progress, checkpoint] {
    progress->series.assign(impl->series.begin(), impl->series.end());
    core::ByteWriter files;
    files(*progress);
    checkpoint->files = files.take();
    return divot::write_checkpoint(impl->path("checkpoint.divot"), *checkpoint);
  });
  return impl_->writer.status();
}

Result<void> Recorder::finish(const World& world, const RunTotals& totals) {
  if (auto written = impl_->writer.status(); !written) return written;
  if (impl_->last_row != world.steps()) add_bodies(world);
  impl_->write(world, "terrain_final", formats_of(world, {"ply", "tif"}), false);
  if (auto written = impl_->writer.drain(); !written) return written;
  impl_->finished = true;
  if (auto written = impl_->bodies.commit(); !written) return written;
  // Last: where there is a summary, the run is complete.
  return output::write_json(impl_->path("summary.json"), output::summary(world, totals));
}

}  // namespace divot
