#include "terrain/dem_warp.h"

#include <fmt/format.h>
#include <gdalwarper.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/gdal.h"
#include "terrain/height_field.h"

namespace divot::terrain {
namespace {

constexpr double kMaxError = 0.01;  // pixels that GDAL may be off where it interpolates the transformation
constexpr float kHole = std::numeric_limits<float>::quiet_NaN();

// GDAL's view of pixels that stay where they are.
GDALDatasetUniquePtr wrap(DemPixels& pixels) {
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("MEM");
  if (driver == nullptr) return nullptr;
  GDALDatasetUniquePtr out(
      driver->Create("", static_cast<int>(pixels.columns), static_cast<int>(pixels.rows), 0, GDT_Float32, nullptr));
  CPLStringList options;
  options.SetNameValue("DATAPOINTER", fmt::format("{}", static_cast<void*>(pixels.height.data())).c_str());
  if (!out || out->AddBand(GDT_Float32, options.List()) != CE_None) return nullptr;
  out->SetGeoTransform(pixels.transform.data());
  if (!pixels.crs.IsEmpty()) out->SetSpatialRef(&pixels.crs);
  out->GetRasterBand(1)->SetNoDataValue(kHole);
  return out;
}

// The same area in square pixels of another size.
void set_spacing(DemPixels& pixels, double spacing) {
  const auto count = [&](std::uint32_t before, double size) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(before * std::abs(size) / spacing), 1.0, 4e9));
  };
  pixels.columns = count(pixels.columns, pixels.transform[1]);
  pixels.rows = count(pixels.rows, pixels.transform[5]);
  pixels.transform[1] = spacing;
  pixels.transform[5] = -spacing;
}

// Size and place of the resampled grid; without a spacing, its pixels are as long as the source's on the diagonal.
bool lay_out(GDALDataset& source, const std::string& target_wkt, double spacing, DemPixels& out) {
  CPLStringList options;
  if (!target_wkt.empty()) options.SetNameValue("DST_SRS", target_wkt.c_str());
  const std::unique_ptr<void, void (*)(void*)> transformer(
      GDALCreateGenImgProjTransformer2(&source, nullptr, options.List()), GDALDestroyGenImgProjTransformer);
  int columns = 0, rows = 0;
  if (!transformer || GDALSuggestedWarpOutput(&source, GDALGenImgProjTransform, transformer.get(), out.transform.data(),
                                              &columns, &rows) != CE_None) {
    return false;
  }
  out.columns = static_cast<std::uint32_t>(columns);
  out.rows = static_cast<std::uint32_t>(rows);
  if (spacing > 0) set_spacing(out, spacing);
  return true;
}

// A window of pixels, [first, last).
struct Window {
  std::uint32_t column0, column1, row0, row1;
};

bool mostly_holes(const DemPixels& pixels, const Window& w) {
  std::size_t holes = 0;
  for (std::uint32_t row = w.row0; row < w.row1; ++row)
    for (std::uint32_t column = w.column0; column < w.column1; ++column)
      holes += std::isnan(pixels.height[static_cast<std::size_t>(row) * pixels.columns + column]);
  return 2 * holes > static_cast<std::size_t>(w.column1 - w.column0) * (w.row1 - w.row0);
}

// A grid that was turned a little has wedges without data along its borders.
Window window_with_data(const DemPixels& pixels) {
  Window w{0, pixels.columns, 0, pixels.rows};
  for (bool trimmed = true; trimmed && w.column1 - w.column0 > 3 && w.row1 - w.row0 > 3;) {
    trimmed = false;
    const auto trim = [&](const Window& border, std::uint32_t& side, std::uint32_t inner) {
      if (mostly_holes(pixels, border)) side = inner, trimmed = true;
    };
    trim({w.column0, w.column1, w.row0, w.row0 + 1}, w.row0, w.row0 + 1);
    trim({w.column0, w.column1, w.row1 - 1, w.row1}, w.row1, w.row1 - 1);
    trim({w.column0, w.column0 + 1, w.row0, w.row1}, w.column0, w.column0 + 1);
    trim({w.column1 - 1, w.column1, w.row0, w.row1}, w.column1, w.column1 - 1);
  }
  return w;
}

void crop(DemPixels& pixels, const Window& w) {
  std::vector<float> height;
  for (std::uint32_t row = w.row0; row < w.row1; ++row) {
    const auto first = pixels.height.begin() + static_cast<std::ptrdiff_t>(row) * pixels.columns;
    height.insert(height.end(), first + w.column0, first + w.column1);
  }
  pixels.transform[0] += w.column0 * pixels.transform[1];
  pixels.transform[3] += w.row0 * pixels.transform[5];
  pixels.columns = w.column1 - w.column0;
  pixels.rows = w.row1 - w.row0;
  pixels.height = std::move(height);
}

}  // namespace

Result<DemPixels> warp(const DemTerrain& dem, DemPixels& source, const OGRSpatialReference& target,
                       std::uint64_t max_vertices) {
  const core::GdalSession session;
  const auto fail_warp = [&] {
    return fail(
        dem_error(dem, "cannot be resampled to a grid in metres (" + session.message("GDAL gave up") + ")", {}));
  };
  const GDALDatasetUniquePtr from = wrap(source);
  DemPixels out;
  out.crs = target;
  if (!from || !lay_out(*from, wkt_of(target), dem.spacing, out)) return fail_warp();
  if (auto ok = check_size(out.columns, out.rows, max_vertices, dem_error(dem, {}, {})); !ok) {
    return tl::unexpected(ok.error());
  }

  // Cubic keeps peaks and pits, which bilinear planes off by metres; beside holes GDAL falls back to bilinear by
  // itself.
  out.height.assign(static_cast<std::size_t>(out.columns) * out.rows, kHole);
  const GDALDatasetUniquePtr to = wrap(out);
  if (!to || GDALReprojectImage(from.get(), nullptr, to.get(), nullptr, GRA_Cubic, 0, kMaxError, nullptr, nullptr,
                                nullptr) != CE_None) {
    return fail_warp();
  }
  crop(out, window_with_data(out));
  return out;
}

}  // namespace divot::terrain
