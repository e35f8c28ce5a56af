#include "terrain/dem_coordinates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/gdal.h"
#include "terrain/dem_warp.h"

namespace divot::terrain {
namespace {

// Transverse Mercator stretches by 1.5 % at 10 degrees from its middle, and quickly more beyond.
constexpr double kWidest = 20;  // degrees

struct Extent {
  double west, east, south, north;
  double width() const { return east - west; }
  double height() const { return north - south; }
};

Extent extent_of(const DemPixels& pixels) {
  const auto& t = pixels.transform;
  Extent e{t[0], t[0], t[3], t[3]};
  for (const double i : {0.0, static_cast<double>(pixels.columns)}) {
    for (const double j : {0.0, static_cast<double>(pixels.rows)}) {
      const double x = t[0] + i * t[1] + j * t[2], y = t[3] + i * t[4] + j * t[5];
      e.west = std::min(e.west, x), e.east = std::max(e.east, x);
      e.south = std::min(e.south, y), e.north = std::max(e.north, y);
    }
  }
  return e;
}

tl::unexpected<Errors> fail_crs(const DemTerrain& dem, std::string problem, std::string expected) {
  Error error = dem_error(dem, std::move(problem), std::move(expected));
  error.key = "terrain.crs";
  return fail(std::move(error));
}

// Degrees taken for metres are cliffs a thousand times too steep.
bool looks_like_degrees(const DemPixels& pixels) {
  const Extent e = extent_of(pixels);
  const double cell = std::max(e.width() / pixels.columns, e.height() / pixels.rows);
  return e.west >= -180 && e.east <= 180 && e.south >= -90 && e.north <= 90 && cell < 0.1;
}

bool is_rotated(const DemPixels& pixels) { return pixels.transform[2] != 0 || pixels.transform[4] != 0; }

// Metres instead of the coordinate system's own unit, in the pixels' transform and in the system itself.
void convert_linear_unit(DemPixels& pixels) {
  const double unit = pixels.crs.GetLinearUnits();
  if (unit == 1.0) return;
  for (double& t : pixels.transform) t *= unit;
  pixels.crs.SetLinearUnitsAndUpdateParameters(SRS_UL_METER, 1.0);
}

// The local system for a geographic model: metres east and north of its middle.
Result<OGRSpatialReference> local_system(const DemTerrain& dem, const DemPixels& pixels) {
  const core::GdalSession session;
  const Extent e = extent_of(pixels);
  const double degrees = pixels.crs.GetAngularUnits() * 180 / 3.14159265358979323846;
  if (std::max(std::abs(e.south), std::abs(e.north)) * degrees > 90.01) {
    return fail_crs(dem, fmt::format("latitudes from {} to {} are no degrees", e.south, e.north),
                    "expected a projected coordinate system");
  }
  if (std::max(e.width(), e.height()) * degrees > kWidest) {
    return fail_crs(dem,
                    fmt::format("{:.1f} x {:.1f} degrees are too wide for one flat terrain", e.width() * degrees,
                                e.height() * degrees),
                    fmt::format("expected at most {} degrees, or a model in a projected system", kWidest));
  }

  OGRSpatialReference wgs84;
  wgs84.SetWellKnownGeogCS("WGS84");
  wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::unique_ptr<OGRCoordinateTransformation> to_wgs84(OGRCreateCoordinateTransformation(&pixels.crs, &wgs84));
  double lon = (e.west + e.east) / 2, lat = (e.south + e.north) / 2;
  OGRSpatialReference local;
  if (!to_wgs84 || !to_wgs84->Transform(1, &lon, &lat) ||
      local.importFromProj4(
          fmt::format("+proj=tmerc +lat_0={} +lon_0={} +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m", lat, lon).c_str()) !=
          OGRERR_NONE) {
    return fail_crs(dem, "cannot be brought to metres (" + session.message("no transformation") + ")", {});
  }
  local.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return local;
}

// The same pixels on a north-up grid whose coordinates are metres.
Result<DemPixels> to_north_up(const DemTerrain& dem, DemPixels pixels, std::uint64_t max_vertices) {
  if (pixels.crs.IsEmpty()) {
    if (dem.pixel <= 0 && looks_like_degrees(pixels)) {
      return fail_crs(dem, "the coordinates look like degrees, and the file has no coordinate system",
                      "expected `crs = \"EPSG:4326\"` for degrees, or the projected system they are in");
    }
  } else if (pixels.crs.IsGeographic()) {
    const auto local = local_system(dem, pixels);
    if (!local) return tl::unexpected(local.error());
    return warp(dem, pixels, *local, max_vertices);
  } else if (pixels.crs.IsProjected() || pixels.crs.IsLocal()) {
    convert_linear_unit(pixels);
  } else {
    return fail_crs(dem, fmt::format("`{}` is no system for a map", pixels.crs.GetName()),
                    "expected a projected or a geographic one");
  }
  if (!is_rotated(pixels) && dem.spacing == 0) return pixels;
  const OGRSpatialReference same = pixels.crs;
  return warp(dem, pixels, same, max_vertices);
}

// Files run from north to south as a rule, grids here from south to north and west to east.
HeightField to_field(const DemPixels& pixels) {
  const auto& t = pixels.transform;
  const bool mirrored = t[1] < 0, north_first = t[5] < 0;
  HeightField field;
  field.raster.layout = {pixels.columns, pixels.rows};
  field.raster.dx = std::abs(t[1]);
  field.raster.dy = std::abs(t[5]);
  field.raster.x0 = t[0] + t[1] * (mirrored ? pixels.columns - 0.5 : 0.5);
  field.raster.y0 = t[3] + t[5] * (north_first ? pixels.rows - 0.5 : 0.5);
  field.raster.crs = wkt_of(pixels.crs);
  field.height.reserve(pixels.height.size());
  for (std::uint32_t row = 0; row < pixels.rows; ++row) {
    const auto first = pixels.height.begin() +
                       static_cast<std::ptrdiff_t>(pixels.columns) * (north_first ? pixels.rows - 1 - row : row);
    field.height.insert(field.height.end(), first, first + pixels.columns);
    if (mirrored) std::reverse(field.height.end() - pixels.columns, field.height.end());
  }
  return field;
}

}  // namespace

Result<HeightField> to_metres(const DemTerrain& dem, DemPixels pixels, std::uint64_t max_vertices) {
  const std::string degrees = pixels.crs.IsGeographic() ? wkt_of(pixels.crs) : "";
  auto flat = to_north_up(dem, std::move(pixels), max_vertices);
  if (!flat) return tl::unexpected(flat.error());
  const auto& t = flat->transform;
  if (!(std::abs(t[1]) > 0) || !(std::abs(t[5]) > 0) || !std::isfinite(t[0] + t[1] + t[3] + t[5])) {
    return fail(dem_error(dem, fmt::format("pixels of {} x {} m", t[1], t[5]), "expected pixels with a size"));
  }
  HeightField field = to_field(*flat);
  field.raster.file_crs = degrees;
  return field;
}

}  // namespace divot::terrain
