#include "terrain/map_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/gdal.h"

namespace divot::terrain {
namespace {

using core::GdalSession;

tl::unexpected<Errors> fail_map(const MaterialMap& map, std::string problem, std::string expected = {}) {
  return fail(map_error(map, std::move(problem), std::move(expected)));
}

tl::unexpected<Errors> fail_legend(const MaterialMap& map, std::string problem, std::string expected) {
  Error error = map_error(map, std::move(problem), std::move(expected));
  error.key = "terrain.material_map.legend";
  return fail(std::move(error));
}

std::string pixel_text(bool color, double value) {
  return color ? fmt::format("#{:06x}", static_cast<std::uint32_t>(value)) : fmt::format("{}", value);
}

std::string listed(const std::vector<std::string>& words) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) out += i + 1 < words.size() ? ", " : " or ";
    out += words[i];
  }
  return out;
}

Result<GDALDatasetUniquePtr> open(const MaterialMap& map, const GdalSession& session) {
  std::error_code ignored;
  if (!std::filesystem::exists(map.image, ignored)) return fail_map(map, "the file does not exist");
  GDALDatasetUniquePtr file(
      GDALDataset::Open(map.image.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
  if (!file || file->GetRasterCount() == 0) {
    return fail_map(map, "not a raster that can be read (" + session.message("it has no bands") + ")",
                    "expected a PNG, a GeoTIFF or another raster format of GDAL");
  }
  return file;
}

// How a file's bands become one number a pixel: the first band as it is, or red, green and blue as 0xrrggbb.
struct Coding {
  bool color = false;
  const GDALColorTable* palette = nullptr;
  int bands = 1;
};

Result<Coding> coding_of(const MaterialMap& map, GDALDataset& file) {
  GDALRasterBand& first = *file.GetRasterBand(1);
  const bool wants_color = map.legend.front().color;
  const bool has_color = file.GetRasterCount() >= 3 && first.GetColorInterpretation() == GCI_RedBand;
  if (!wants_color) {
    if (!has_color) return Coding{};
    return fail_legend(map, "the image is in colour", "expected colours as \"#8a6f4d\" for its pixels");
  }
  if (const GDALColorTable* palette = first.GetColorTable()) return Coding{true, palette, 1};
  if (has_color && first.GetRasterDataType() == GDT_Byte) return Coding{true, nullptr, 3};
  return fail_legend(map, "the image has no colours of 8 bits", "expected numbers for its pixels");
}

double color_of(const GDALColorTable& palette, double index) {
  GDALColorEntry entry{};
  palette.GetColorEntryAsRGB(static_cast<int>(index), &entry);
  return entry.c1 * 65536.0 + entry.c2 * 256.0 + entry.c3;
}

// Some rows of a map as numbers, and which of them are data.
struct Rows {
  std::vector<double> value, band;
  std::vector<std::uint8_t> mask;
};

bool read_rows(GDALDataset& file, const Coding& coding, int row, int count, Rows& rows) {
  GDALRasterBand& first = *file.GetRasterBand(1);
  const int columns = file.GetRasterXSize();
  if (first.GetMaskFlags() != GMF_ALL_VALID &&
      first.GetMaskBand()->RasterIO(GF_Read, 0, row, columns, count, rows.mask.data(), columns, count, GDT_Byte, 0, 0,
                                    nullptr) != CE_None)
    return false;
  std::fill(rows.value.begin(), rows.value.end(), 0.0);
  for (int b = 1; b <= coding.bands; ++b) {
    if (file.GetRasterBand(b)->RasterIO(GF_Read, 0, row, columns, count, rows.band.data(), columns, count, GDT_Float64,
                                        0, 0, nullptr) != CE_None)
      return false;
    for (std::size_t k = 0; k < rows.value.size(); ++k) rows.value[k] = 256 * rows.value[k] + rows.band[k];
  }
  if (coding.palette != nullptr)
    for (double& value : rows.value) value = color_of(*coding.palette, value);
  return true;
}

// Index of a value's entry, or kNoEntry. Neighbouring pixels are alike, so the last answer is tried first.
class Legend {
 public:
  explicit Legend(const MaterialMap& map) : map_(map), seen_(map.legend.size(), false) {}

  std::uint8_t find(double value) {
    const auto holds = [&](std::size_t i) { return static_cast<double>(map_.legend[i].pixel) == value; };
    if (holds(last_)) return seen_[last_] = true, static_cast<std::uint8_t>(last_);
    for (std::size_t i = 0; i < map_.legend.size(); ++i)
      if (holds(i)) return last_ = i, seen_[i] = true, static_cast<std::uint8_t>(i);
    return MapPixels::kNoEntry;
  }

  std::string all() const {
    return text([](std::size_t) { return true; });
  }
  std::string seen() const {
    return text([&](std::size_t i) { return seen_[i]; });
  }
  std::string not_seen() const {
    return text([&](std::size_t i) { return !seen_[i]; });
  }

 private:
  template <class Filter>
  std::string text(Filter keep) const {
    std::vector<std::string> words;
    for (std::size_t i = 0; i < map_.legend.size(); ++i)
      if (keep(i)) words.push_back(map_.legend[i].text());
    return listed(words);
  }

  const MaterialMap& map_;
  std::vector<bool> seen_;
  std::size_t last_ = 0;
};

Result<void> read_entries(const MaterialMap& map, GDALDataset& file, const Coding& coding, const GdalSession& session,
                          MapPixels& out) {
  constexpr std::uint32_t kRows = 64;
  Legend legend(map);
  Rows rows;
  for (std::uint32_t row = 0; row < out.rows; row += kRows) {
    const std::uint32_t count = std::min(kRows, out.rows - row);
    const std::size_t pixels = static_cast<std::size_t>(count) * out.columns;
    rows.value.resize(pixels), rows.band.resize(pixels), rows.mask.assign(pixels, 255);
    if (!read_rows(file, coding, static_cast<int>(row), static_cast<int>(count), rows) || session.failed())
      return fail_map(map, "cannot be read to its end (" + session.message("damaged") + ")");
    for (std::size_t k = 0; k < pixels; ++k) {
      if (rows.mask[k] == 0 || std::isnan(rows.value[k])) continue;
      const std::uint8_t entry = legend.find(rows.value[k]);
      if (entry == MapPixels::kNoEntry) {
        return fail_legend(map,
                           fmt::format("has no entry for {}, which is in column {}, row {} of the image, counted from "
                                       "0 at its first corner",
                                       pixel_text(coding.color, rows.value[k]), k % out.columns, row + k / out.columns),
                           fmt::format("expected only {} there, or an entry for it", legend.all()));
      }
      out.entry[static_cast<std::size_t>(row) * out.columns + k] = entry;
    }
  }
  if (const std::string missing = legend.not_seen(); !missing.empty()) {
    const std::string seen = legend.seen();
    return fail_legend(
        map, "no pixel of the image is " + missing,
        seen.empty() ? "expected an image with data" : fmt::format("expected it left out: the image holds {}", seen));
  }
  return {};
}

}  // namespace

Error map_error(const MaterialMap& map, std::string problem, std::string expected) {
  return {.file = map.image,
          .line = 0,
          .key = "terrain.material_map.image",
          .problem = std::move(problem),
          .expected = std::move(expected)};
}

Result<MapPixels> read_map(const MaterialMap& map, std::uint64_t max_pixels) {
  const GdalSession session;
  auto file = open(map, session);
  if (!file) return tl::unexpected(file.error());
  const auto coding = coding_of(map, **file);
  if (!coding) return tl::unexpected(coding.error());

  MapPixels out;
  out.columns = static_cast<std::uint32_t>((*file)->GetRasterXSize());
  out.rows = static_cast<std::uint32_t>((*file)->GetRasterYSize());
  if (const std::uint64_t pixels = std::uint64_t{out.columns} * out.rows; pixels > max_pixels) {
    return fail_map(map, fmt::format("{} x {} are {} pixels", out.columns, out.rows, pixels),
                    fmt::format("expected at most terrain.max_vertices, which is {}", max_pixels));
  }
  std::array<double, 6> transform{};
  if ((*file)->GetGeoTransform(transform.data()) == CE_None) out.transform = transform;
  if (!map.crs.empty()) {
    const CSLConstList offline = OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get();
    if (out.crs.SetFromUserInput(map.crs.c_str(), offline) != OGRERR_NONE) {
      Error error =
          map_error(map, fmt::format("`{}` is no coordinate system ({})", map.crs, session.message("unknown to PROJ")),
                    "expected one as `EPSG:4326` or WKT");
      error.key = "terrain.material_map.crs";
      return fail(std::move(error));
    }
  } else if (const OGRSpatialReference* own = (*file)->GetSpatialRef()) {
    out.crs = *own;
  }
  out.crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);

  out.entry.assign(static_cast<std::size_t>(out.columns) * out.rows, MapPixels::kNoEntry);
  if (auto ok = read_entries(map, **file, *coding, session, out); !ok) return tl::unexpected(ok.error());
  return out;
}

}  // namespace divot::terrain
