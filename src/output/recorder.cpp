#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <utility>
#include <vector>

#include "divot/output.h"
#include "output/csv.h"
#include "output/geotiff.h"
#include "output/json.h"
#include "output/ply.h"
#include "output/summary.h"

namespace divot {

struct Recorder::Impl {
  Impl(std::string results_folder, output::BodiesCsv rows)
      : folder(std::move(results_folder)), bodies(std::move(rows)) {}

  std::string path(const std::string& name) const { return (std::filesystem::path(folder) / name).string(); }

  std::string folder;
  output::BodiesCsv bodies;
  std::uint64_t frames = 0;
};

namespace {

// Everything that went wrong, so that one full disk is not reported file by file in as many runs.
class Failures {
 public:
  void keep(const Result<void>& result) {
    if (!result) errors_.insert(errors_.end(), result.error().begin(), result.error().end());
  }
  Result<void> take() {
    if (errors_.empty()) return {};
    return tl::unexpected(std::move(errors_));
  }

 private:
  Errors errors_;
};

std::vector<float> sinkage_of(const World& world) {
  std::vector<float> sinkage(world.surface().positions.size());
  for (std::uint32_t v = 0; v < sinkage.size(); ++v) sinkage[v] = world.sinkage(v);
  return sinkage;
}

// The ground as one of OutputSettings::formats.
Result<void> write_ground(const World& world, const std::string& format, const std::string& path) {
  if (format == "ply") return output::write_ply(path, world.surface(), sinkage_of(world));
  if (format == "csv") return output::write_surface_csv(path, world.surface(), sinkage_of(world));
  const std::optional<RasterView> raster = world.raster();
  return raster ? output::write_geotiff(path, *raster) : Result<void>{};
}

}  // namespace

Recorder::Recorder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;
Recorder::~Recorder() = default;

Result<Recorder> Recorder::create(const std::string& folder) {
  if (const auto made = output::make_folder(folder); !made) return tl::unexpected(made.error());
  auto bodies = output::BodiesCsv::create((std::filesystem::path(folder) / "bodies.csv").string());
  if (!bodies) return tl::unexpected(bodies.error());
  return Recorder(std::make_unique<Impl>(folder, std::move(*bodies)));
}

void Recorder::add_bodies(const World& world) { impl_->bodies.append(world.time(), world.bodies()); }

Result<void> Recorder::write_frame(const World& world) {
  Failures failures;
  for (const std::string& format : world.scene().output.formats)
    failures.keep(write_ground(world, format, impl_->path(fmt::format("frame_{:06}.{}", impl_->frames, format))));
  ++impl_->frames;
  return failures.take();
}

Result<void> Recorder::finish(const World& world, const RunTotals& totals) {
  Failures failures;
  failures.keep(impl_->bodies.commit());
  std::set<std::string> formats = {"ply", "tif"};
  formats.insert(world.scene().output.formats.begin(), world.scene().output.formats.end());
  for (const std::string& format : formats)
    failures.keep(write_ground(world, format, impl_->path(fmt::format("terrain_final.{}", format))));
  // Last: where there is a summary, the run is complete.
  failures.keep(output::write_json(impl_->path("summary.json"), output::summary(world, totals)));
  return failures.take();
}

}  // namespace divot
