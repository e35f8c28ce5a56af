#include "output/results.h"

#include <filesystem>
#include <vector>

#include "output/geotiff.h"
#include "output/json.h"
#include "output/ply.h"
#include "output/summary.h"

namespace divot::output {
namespace {

Result<void> write_surface(const World& world, const std::string& path) {
  const SurfaceView surface = world.surface();
  std::vector<float> sinkage(surface.positions.size());
  for (std::uint32_t v = 0; v < sinkage.size(); ++v) sinkage[v] = world.sinkage(v);
  return write_ply(path, surface, sinkage);
}

}  // namespace

Result<void> write_results(const World& world, const std::string& folder, double wall_s, BodiesCsv bodies,
                           const std::optional<RasterView>& raster) {
  const auto path = [&](const char* name) { return (std::filesystem::path(folder) / name).string(); };
  Errors errors;
  const auto keep = [&](const Result<void>& result) {
    if (!result) errors.insert(errors.end(), result.error().begin(), result.error().end());
  };
  keep(bodies.commit());
  keep(write_surface(world, path("terrain_final.ply")));
  if (raster) keep(write_geotiff(path("terrain_final.tif"), *raster));
  // Last: where there is a summary, the run is complete.
  keep(write_json(path("summary.json"), summary(world, wall_s)));
  if (!errors.empty()) return tl::unexpected(std::move(errors));
  return {};
}

}  // namespace divot::output
