#include "terrain/dem_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>

#include "core/gdal.h"
#include "terrain/dem_fill.h"
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

// An open raster; `numbers` are the pixels of one that GDAL has no driver for.
struct RasterFile {
  std::vector<std::uint16_t> numbers;
  GDALDatasetUniquePtr file;
};

bool is_raw(const DemTerrain& dem) {
  const std::string ending = std::filesystem::path(dem.path).extension().string();
  return ending == ".raw" || ending == ".r16" || ending == ".RAW" || ending == ".R16";
}

// 16-bit numbers, low byte first, row by row from the north: what game engines write and read.
Result<RasterFile> open_raw(const DemTerrain& dem) {
  std::ifstream in(dem.path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  if (!in) return fail_dem(dem, "cannot be read");
  const std::size_t count = bytes.size() / 2;
  const auto columns = dem.raw_columns > 0
                           ? static_cast<std::size_t>(dem.raw_columns)
                           : static_cast<std::size_t>(std::llround(std::sqrt(static_cast<double>(count))));
  if (columns == 0 || bytes.size() % 2 != 0 || count % columns != 0 ||
      (dem.raw_columns == 0 && count != columns * columns)) {
    Error error = dem_error(dem,
                            fmt::format("{} bytes are no {} of 16-bit numbers", bytes.size(),
                                        dem.raw_columns > 0 ? fmt::format("rows of {}", columns) : "square"),
                            "expected `raw_columns`, of which the file holds whole rows");
    error.key = "terrain.raw_columns";
    return fail(std::move(error));
  }
  RasterFile out;
  for (std::size_t k = 0; k < count; ++k)
    out.numbers.push_back(static_cast<std::uint16_t>(static_cast<unsigned char>(bytes[2 * k]) |
                                                     static_cast<unsigned char>(bytes[2 * k + 1]) << 8));
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("MEM");
  out.file.reset(driver == nullptr ? nullptr
                                   : driver->Create("", static_cast<int>(columns), static_cast<int>(count / columns), 0,
                                                    GDT_UInt16, nullptr));
  CPLStringList options;
  options.SetNameValue("DATAPOINTER", fmt::format("{}", static_cast<void*>(out.numbers.data())).c_str());
  if (!out.file || out.file->AddBand(GDT_UInt16, options.List()) != CE_None)
    return fail_dem(dem, "cannot be taken as a raster");
  return out;
}

Result<RasterFile> open(const DemTerrain& dem, const GdalSession& session) {
  std::error_code ignored;
  if (!std::filesystem::exists(dem.path, ignored)) return fail_dem(dem, "the file does not exist");
  if (is_raw(dem)) return open_raw(dem);
  GDALDatasetUniquePtr file(
      GDALDataset::Open(dem.path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
  if (!file || file->GetRasterCount() == 0) {
    return fail_dem(dem, "not a raster that can be read (" + reason(dem, session, "it has no bands") + ")",
                    "expected a GeoTIFF, an Esri ASCII grid or another raster format of GDAL");
  }
  return RasterFile{{}, std::move(file)};
}

// Where the pixels lie: round the origin where the scene says how large they are.
Result<std::array<double, 6>> transform_of(const DemTerrain& dem, GDALDataset& file) {
  std::array<double, 6> t{};
  if (dem.pixel > 0)
    return std::array{-dem.pixel * file.GetRasterXSize() / 2, dem.pixel, 0.0,
                      dem.pixel * file.GetRasterYSize() / 2,  0.0,       -dem.pixel};
  if (file.GetGeoTransform(t.data()) == CE_None) return t;
  return fail_dem(dem, "the file does not say how large its pixels are and where they lie",
                  "expected a georeferenced raster, a world file beside it, or `pixel = 1.0` for metres");
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

// The pixels that are read: from a column and row on, each of the result standing for step x step of the file.
struct Part {
  std::uint32_t column = 0, row = 0, columns = 0, rows = 0, step = 1;
};

tl::unexpected<Errors> fail_part(const DemTerrain& dem, const char* key, std::string problem, std::string expected) {
  Error error = dem_error(dem, std::move(problem), std::move(expected));
  error.key = key;
  return fail(std::move(error));
}

Result<Part> window_of(const DemTerrain& dem, std::uint32_t columns, std::uint32_t rows) {
  const PixelWindow& w = dem.window;
  const auto column = static_cast<std::uint32_t>(w.column), row = static_cast<std::uint32_t>(w.row);
  const auto wide = static_cast<std::uint32_t>(w.columns), high = static_cast<std::uint32_t>(w.rows);
  if (column < columns && row < rows && wide <= columns - column && high <= rows - row)
    return Part{column, row, wide > 0 ? wide : columns - column, high > 0 ? high : rows - row};
  return fail_part(dem, "terrain.window", "reaches beyond the file",
                   fmt::format("expected a part of its {} x {} pixels", columns, rows));
}

// The pixels that meet the box, of a raster that may be turned.
Result<Part> box_of(const DemTerrain& dem, std::array<double, 6> t, std::uint32_t columns, std::uint32_t rows) {
  const MapBox& b = dem.box;
  std::array<double, 6> back{};
  std::array<double, 4> bounds{1e300, -1e300, 1e300, -1e300};  // of columns, of rows
  if (!GDALInvGeoTransform(t.data(), back.data()))
    return fail_part(dem, "terrain.box", "the file's pixels have no area", "expected `window`");
  for (const double x : {b.west, b.east})
    for (const double y : {b.south, b.north}) {
      const double i = back[0] + x * back[1] + y * back[2], j = back[3] + x * back[4] + y * back[5];
      bounds = {std::min(bounds[0], i), std::max(bounds[1], i), std::min(bounds[2], j), std::max(bounds[3], j)};
    }
  // A border on the edge of a pixel does not take the next one in.
  constexpr double kSlack = 1e-6;
  const double c0 = std::max(0.0, std::floor(bounds[0] + kSlack)),
               c1 = std::min<double>(columns, std::ceil(bounds[1] - kSlack));
  const double r0 = std::max(0.0, std::floor(bounds[2] + kSlack)),
               r1 = std::min<double>(rows, std::ceil(bounds[3] - kSlack));
  if (c1 > c0 && r1 > r0)
    return Part{static_cast<std::uint32_t>(c0), static_cast<std::uint32_t>(r0), static_cast<std::uint32_t>(c1 - c0),
                static_cast<std::uint32_t>(r1 - r0)};
  return fail_part(dem, "terrain.box", "lies beside the file",
                   fmt::format("expected it within x {} to {}, y {} to {}", std::min(t[0], t[0] + columns * t[1]),
                               std::max(t[0], t[0] + columns * t[1]), std::min(t[3], t[3] + rows * t[5]),
                               std::max(t[3], t[3] + rows * t[5])));
}

// A spacing of several pixels is read coarsely right away, from the file's overviews where it has them.
std::uint32_t step_of(const DemTerrain& dem, const std::array<double, 6>& t, const OGRSpatialReference& crs) {
  if (dem.spacing <= 0) return 1;
  constexpr double kDegree = 111'320;  // m, at the equator: shorter elsewhere, which reads finer than needed
  const double unit = crs.IsGeographic()  ? kDegree * crs.GetAngularUnits() * 180 / 3.14159265358979323846
                      : crs.IsProjected() ? crs.GetLinearUnits()
                                          : 1;
  const double pixel = std::max(std::hypot(t[1], t[4]), std::hypot(t[2], t[5])) * unit;
  // Half of it, so that resampling to the spacing itself has finer pixels to work with.
  return static_cast<std::uint32_t>(std::clamp(std::floor(dem.spacing / (2 * pixel)), 1.0, 1e6));
}

// What is read, and where it lies.
Result<Part> part_of(const DemTerrain& dem, GDALDataset& file, DemPixels& out) {
  const auto columns = static_cast<std::uint32_t>(file.GetRasterXSize()),
             rows = static_cast<std::uint32_t>(file.GetRasterYSize());
  auto part = dem.box == MapBox{} ? window_of(dem, columns, rows) : box_of(dem, out.transform, columns, rows);
  if (!part) return part;
  part->step =
      std::min({step_of(dem, out.transform, out.crs), std::max(1u, part->columns / 2), std::max(1u, part->rows / 2)});
  out.columns = part->columns / part->step;
  out.rows = part->rows / part->step;
  std::array<double, 6>& t = out.transform;
  t[0] += part->column * t[1] + part->row * t[2];
  t[3] += part->column * t[4] + part->row * t[5];
  for (const std::size_t k : {1u, 2u, 4u, 5u}) t[k] *= part->step;
  return part;
}

// Reads some rows at a time: values as double, so that no type loses digits before they are scaled, and GDAL's mask,
// which knows every way a format has of saying nodata.
Result<void> read_rows(const DemTerrain& dem, GDALRasterBand& band, const Part& part, const Scaling& to_metres,
                       const GdalSession& session, DemPixels& out) {
  constexpr std::uint32_t kRows = 64;
  GDALRasterIOExtraArg mean;
  INIT_RASTERIO_EXTRA_ARG(mean);
  if (part.step > 1) mean.eResampleAlg = GRIORA_Average;
  const int x = static_cast<int>(part.column), step = static_cast<int>(part.step);
  const int columns = static_cast<int>(out.columns);
  const bool masked = band.GetMaskFlags() != GMF_ALL_VALID;
  std::vector<double> value(std::size_t{kRows} * out.columns);
  std::vector<std::uint8_t> mask(value.size(), 255);
  for (std::uint32_t row = 0; row < out.rows; row += kRows) {
    const int y = static_cast<int>(part.row + row * part.step),
              height = static_cast<int>(std::min(kRows, out.rows - row));
    const auto read = [&](GDALRasterBand& from, void* to, GDALDataType type) {
      return from.RasterIO(GF_Read, x, y, columns * step, height * step, to, columns, height, type, 0, 0, &mean) ==
             CE_None;
    };
    const bool ok =
        read(band, value.data(), GDT_Float64) && (!masked || read(*band.GetMaskBand(), mask.data(), GDT_Byte));
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
  auto raster = open(dem, session);
  if (!raster) return tl::unexpected(raster.error());
  GDALDataset& file = *raster->file;
  auto band = band_of(dem, file);
  if (!band) return tl::unexpected(band.error());

  DemPixels out;
  const auto transform = transform_of(dem, file);
  if (!transform) return tl::unexpected(transform.error());
  out.transform = *transform;
  auto crs = crs_of(dem, file, session);
  if (!crs) return tl::unexpected(crs.error());
  const auto unit = height_unit(dem, **band, *crs);
  if (!unit) return tl::unexpected(unit.error());
  out.crs = std::move(*crs);
  out.crs.StripVertical();

  const auto part = part_of(dem, file, out);
  if (!part) return tl::unexpected(part.error());
  if (auto ok = check_size(out.columns, out.rows, max_vertices, dem_error(dem, {}, {})); !ok) {
    return tl::unexpected(ok.error());
  }
  out.height.resize(static_cast<std::size_t>(out.columns) * out.rows);
  const Scaling to_metres{(*band)->GetScale() * *unit * dem.height_scale,
                          (*band)->GetOffset() * *unit * dem.height_scale + dem.height_offset};
  if (auto ok = read_rows(dem, **band, *part, to_metres, session, out); !ok) return tl::unexpected(ok.error());
  if (dem.nodata == Nodata::fill) fill_holes(out);
  return out;
}

}  // namespace divot::terrain
