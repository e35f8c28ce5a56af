#include "terrain/dem.h"

#include <cmath>

#include "terrain/dem_coordinates.h"
#include "terrain/dem_file.h"
#include "terrain/height_field.h"

namespace divot::terrain {
namespace {

// Mean height in whole metres: particles are floats around it, which keeps them finer than a millimetre on a mountain
// of 4000 m, and a whole number keeps heights in whole metres exact.
double level(const std::vector<float>& height) {
  double sum = 0, count = 0;
  for (const float z : height)
    if (!std::isnan(z)) sum += z, count += 1;
  return count > 0 ? std::round(sum / count) : 0;
}

Vec3d middle(const HeightField& field) {
  const state::Raster& raster = field.raster;
  return {raster.x0 + raster.dx * (raster.layout.columns - 1) / 2, raster.y0 + raster.dy * (raster.layout.rows - 1) / 2,
          level(field.height)};
}

}  // namespace

Result<state::Surface> load_dem(const DemTerrain& dem, std::uint64_t max_vertices) {
  auto pixels = read_dem(dem, max_vertices);
  if (!pixels) return tl::unexpected(pixels.error());
  auto field = to_metres(dem, std::move(*pixels), max_vertices);
  if (!field) return tl::unexpected(field.error());
  const Vec3d origin = middle(*field);
  return build_surface(std::move(*field), origin, dem_error(dem, {}, {}));
}

}  // namespace divot::terrain
