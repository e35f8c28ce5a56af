#include "terrain/dem_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

#include "core/gdal.h"
#include "terrain/height_field.h"

namespace divot::terrain {
namespace {

using core::GdalSession;

// Nothing on a planet is higher or deeper; what is was meant as nodata.
constexpr double kHighest = 100'000;  // m

tl::unexpected<Errors> fail_dem(const DemTerrain& dem, std::string problem, std::string expected = {}) {
  return fail(dem_error(dem, std::move(problem), std::move(expected)));
}

// GDAL's words, without the path, which the error has already.
std::string reason(const DemTerrain& dem, const GdalSession& session, const char* otherwise) {
  std::string out = session.message(otherwise);
  const std::string name = "the file";
  for (std::size_t at = 0; !dem.path.empty() && (at = out.find(dem.path, at)) != std::string::npos; at += name.size())
    out.replace(at, dem.path.size(), name);
  return out;
}

Result<GDALDatasetUniquePtr> open(const DemTerrain& dem, const GdalSession& session) {
  std::error_code ignored;
  if (!std::filesystem::exists(dem.path, ignored)) return fail_dem(dem, "the file does not exist");
  GDALDatasetUniquePtr file(
      GDALDataset::Open(dem.path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
  if (!file || file->GetRasterCount() == 0) {
    return fail_dem(dem, "not a raster that can be read (" + reason(dem, session, "it has no bands") + ")",
                    "expected a GeoTIFF, an Esri ASCII grid or another raster format of GDAL");
  }
  return file;
}

Result<GDALRasterBand*> band_of(const DemTerrain& dem, GDALDataset& file) {
  if (dem.band >= 1 && dem.band <= file.GetRasterCount()) return file.GetRasterBand(dem.band);
  Error error = dem_error(dem, fmt::format("band {} is not in the file", dem.band),
                          fmt::format("expected 1 to {}", file.GetRasterCount()));
  error.key = "terrain.band";
  return fail(std::move(error));
}

// What the scene says goes before what the file says: it is there to correct it.
Result<OGRSpatialReference> crs_of(const DemTerrain& dem, const GDALDataset& file, const GdalSession& session) {
  OGRSpatialReference crs;
  if (!dem.crs.empty()) {
    const CSLConstList offline = OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get();
    if (crs.SetFromUserInput(dem.crs.c_str(), offline) != OGRERR_NONE) {
      Error error =
          dem_error(dem, fmt::format("`{}` is no coordinate system ({})", dem.crs, session.message("unknown to PROJ")),
                    "expected one as `EPSG:4326` or WKT");
      error.key = "terrain.crs";
      return fail(std::move(error));
    }
  } else if (const OGRSpatialReference* own = file.GetSpatialRef()) {
    crs = *own;
  }
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return crs;
}

std::optional<double> metres_in(std::string unit) {
  std::transform(unit.begin(), unit.end(), unit.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto is_one_of = [&](std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(), [&](const char* name) { return unit == name; });
  };
  if (is_one_of({"", "m", "metre", "metres", "meter", "meters", "unknown"})) return 1.0;
  if (is_one_of({"ft", "foot", "feet", "international foot", "international feet"})) return 0.3048;
  if (is_one_of({"us survey foot", "us survey feet", "us-ft", "us_ft", "ftus", "ft-us", "foot_us", "survey foot"})) {
    return 1200.0 / 3937.0;
  }
  if (is_one_of({"km", "kilometre", "kilometres", "kilometer", "kilometers"})) return 1000.0;
  if (is_one_of({"dm", "decimetre", "decimetres", "decimeter", "decimeters"})) return 0.1;
  if (is_one_of({"cm", "centimetre", "centimetres", "centimeter", "centimeters"})) return 0.01;
  if (is_one_of({"mm", "millimetre", "millimetres", "millimeter", "millimeters"})) return 0.001;
  return std::nullopt;
}

// The band's unit, or the one of a compound coordinate system's heights.
Result<double> height_unit(const DemTerrain& dem, GDALRasterBand& band, const OGRSpatialReference& crs) {
  const std::string unit = band.GetUnitType();
  if (unit.empty() && crs.IsCompound()) return crs.GetTargetLinearUnits("VERT_CS");
  if (const auto metres = metres_in(unit)) return *metres;
  return fail_dem(dem, fmt::format("heights are in `{}`", unit), "expected metres or feet");
}

struct Scaling {
  double scale = 1, offset = 0;
};

// Reads some rows at a time: values as double, so that no type loses digits before they are scaled, and GDAL's mask,
// which knows every way a format has of saying nodata.
Result<void> read_rows(const DemTerrain& dem, GDALRasterBand& band, const Scaling& to_metres,
                       const GdalSession& session, DemPixels& out) {
  constexpr std::uint32_t kRows = 64;
  const int columns = static_cast<int>(out.columns);
  const bool masked = band.GetMaskFlags() != GMF_ALL_VALID;
  std::vector<double> value(std::size_t{kRows} * out.columns);
  std::vector<std::uint8_t> mask(value.size(), 255);
  for (std::uint32_t row = 0; row < out.rows; row += kRows) {
    const int y = static_cast<int>(row), height = static_cast<int>(std::min(kRows, out.rows - row));
    const bool ok = band.RasterIO(GF_Read, 0, y, columns, height, value.data(), columns, height, GDT_Float64, 0, 0,
                                  nullptr) == CE_None &&
                    (!masked || band.GetMaskBand()->RasterIO(GF_Read, 0, y, columns, height, mask.data(), columns,
                                                             height, GDT_Byte, 0, 0, nullptr) == CE_None);
    if (!ok || session.failed())
      return fail_dem(dem, "cannot be read to its end (" + reason(dem, session, "damaged") + ")");

    float* const to = out.height.data() + static_cast<std::size_t>(row) * out.columns;
    for (std::size_t k = 0; k < static_cast<std::size_t>(height) * out.columns; ++k) {
      if (mask[k] == 0 || !std::isfinite(value[k])) {
        to[k] = std::numeric_limits<float>::quiet_NaN();
        continue;
      }
      const double z = value[k] * to_metres.scale + to_metres.offset;
      if (!(std::abs(z) <= kHighest)) {
        return fail_dem(dem, fmt::format("a height of {} m", z),
                        "expected heights within 100 km, and a nodata value declared in the file");
      }
      to[k] = static_cast<float>(z);
    }
  }
  return {};
}

}  // namespace

Error dem_error(const DemTerrain& dem, std::string problem, std::string expected) {
  return {.file = dem.path,
          .line = 0,
          .key = "terrain.dem",
          .problem = std::move(problem),
          .expected = std::move(expected)};
}

std::string wkt_of(const OGRSpatialReference& crs) {
  char* text = nullptr;
  std::string out;
  if (!crs.IsEmpty() && crs.exportToWkt(&text) == OGRERR_NONE) out = text;
  CPLFree(text);
  return out;
}

Result<DemPixels> read_dem(const DemTerrain& dem, std::uint64_t max_vertices) {
  const GdalSession session;
  auto file = open(dem, session);
  if (!file) return tl::unexpected(file.error());
  auto band = band_of(dem, **file);
  if (!band) return tl::unexpected(band.error());

  DemPixels out;
  out.columns = static_cast<std::uint32_t>((*file)->GetRasterXSize());
  out.rows = static_cast<std::uint32_t>((*file)->GetRasterYSize());
  if (auto ok = check_size(out.columns, out.rows, max_vertices, dem_error(dem, {}, {})); !ok) {
    return tl::unexpected(ok.error());
  }
  if ((*file)->GetGeoTransform(out.transform.data()) != CE_None) {
    return fail_dem(dem, "the file does not say how large its pixels are and where they lie",
                    "expected a georeferenced raster, or a world file beside it");
  }
  auto crs = crs_of(dem, **file, session);
  if (!crs) return tl::unexpected(crs.error());
  const auto unit = height_unit(dem, **band, *crs);
  if (!unit) return tl::unexpected(unit.error());
  out.crs = std::move(*crs);
  out.crs.StripVertical();

  out.height.resize(static_cast<std::size_t>(out.columns) * out.rows);
  const Scaling to_metres{(*band)->GetScale() * *unit, (*band)->GetOffset() * *unit};
  if (auto ok = read_rows(dem, **band, to_metres, session, out); !ok) return tl::unexpected(ok.error());
  return out;
}

}  // namespace divot::terrain
