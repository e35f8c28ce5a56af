#include "output/raster_file.h"

#include <cpl_conv.h>
#include <gdalwarper.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "core/assert.h"
#include "core/gdal.h"
#include "output/atomic_file.h"

namespace divot::output {
namespace {

constexpr int kSteps = 65534;  // from 1 to 65535; 0 is for holes

GDALDatasetUniquePtr create(const char* driver_name, const std::string& path, int columns, int rows, GDALDataType type,
                            const CPLStringList& options) {
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(driver_name);
  if (driver == nullptr) return nullptr;
  return GDALDatasetUniquePtr(driver->Create(path.c_str(), columns, rows, 1, type, options.List()));
}

GDALDatasetUniquePtr create(const char* driver_name, const std::string& path, const RasterView& raster,
                            GDALDataType type, const CPLStringList& options) {
  return create(driver_name, path, static_cast<int>(raster.columns), static_cast<int>(raster.rows), type, options);
}

// Where the pixels lie and what they mean.
void describe(GDALDataset& file, const RasterView& raster, double nodata) {
  // GDAL counts from the outer corner of the first pixel, we from its centre.
  std::array<double, 6> transform{raster.x0 - raster.dx / 2, raster.dx, 0, raster.y0 + raster.dy / 2, 0, -raster.dy};
  file.SetGeoTransform(transform.data());
  if (!raster.crs.empty()) file.SetProjection(raster.crs.c_str());
  file.GetRasterBand(1)->SetNoDataValue(nodata);
  file.GetRasterBand(1)->SetUnitType("m");
}

// `pixel(k)`: what stands in the file for value k.
template <class F>
bool write_pixels(GDALRasterBand& band, const RasterView& raster, F pixel) {
  std::vector<float> line(raster.columns);
  for (std::uint32_t row = 0; row < raster.rows; ++row) {
    const std::size_t first = static_cast<std::size_t>(row) * raster.columns;
    for (std::uint32_t column = 0; column < raster.columns; ++column) line[column] = pixel(first + column);
    const int columns = static_cast<int>(raster.columns);
    if (band.RasterIO(GF_Write, 0, static_cast<int>(row), columns, 1, line.data(), columns, 1, GDT_Float32, 0, 0,
                      nullptr) != CE_None) {
      return false;
    }
  }
  return true;
}

// The same in another coordinate system, on pixels about as large, to a driver's file.
GDALDatasetUniquePtr reproject(GDALDataset& from, const std::string& wkt, double nodata, const char* driver_name,
                               const std::string& path, const CPLStringList& options) {
  constexpr double kMostError = 0.01;  // pixels that GDAL may be off where it interpolates the transformation
  CPLStringList target;
  target.SetNameValue("DST_SRS", wkt.c_str());
  const std::unique_ptr<void, void (*)(void*)> transformer(
      GDALCreateGenImgProjTransformer2(&from, nullptr, target.List()), GDALDestroyGenImgProjTransformer);
  std::array<double, 6> transform{};
  int columns = 0, rows = 0;
  if (!transformer || GDALSuggestedWarpOutput(&from, GDALGenImgProjTransform, transformer.get(), transform.data(),
                                              &columns, &rows) != CE_None) {
    return nullptr;
  }
  GDALDatasetUniquePtr to = create(driver_name, path, columns, rows, GDT_Float32, options);
  if (!to) return nullptr;
  to->SetGeoTransform(transform.data());
  to->SetProjection(wkt.c_str());
  GDALRasterBand& band = *to->GetRasterBand(1);
  band.SetNoDataValue(nodata);
  band.SetUnitType("m");
  if (band.Fill(nodata) != CE_None) return nullptr;
  const CPLErr status =
      GDALReprojectImage(&from, nullptr, to.get(), nullptr, GRA_Bilinear, 0, kMostError, nullptr, nullptr, nullptr);
  return status == CE_None ? std::move(to) : nullptr;
}

tl::unexpected<Errors> fail_write(const std::string& path, const core::GdalSession& session) {
  return fail({.file = path, .problem = "cannot be written: " + session.message("no reason given")});
}

struct Heights {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

Heights range_of(const RasterView& raster) {
  Heights range;
  for (std::size_t k = 0; k < raster.heights.size(); ++k) {
    if (raster.holes[k]) continue;
    range.low = std::min<double>(range.low, raster.heights[k]);
    range.high = std::max<double>(range.high, raster.heights[k]);
  }
  return range.low <= range.high ? range : Heights{0, 0};
}

}  // namespace

Result<void> write_geotiff(const std::string& path, const RasterView& raster, std::span<const float> values) {
  DIVOT_ASSERT(values.size() == static_cast<std::size_t>(raster.columns) * raster.rows);
  DIVOT_ASSERT(raster.holes.size() == values.size());
  auto target = AtomicFile::create(path);
  if (!target) return tl::unexpected(target.error());

  // The file is flushed when it is closed, and that has no status of its own: the session hears what goes wrong.
  core::GdalSession session;
  // What a TIFF cannot say of a rare coordinate system would go to a second file, under the temporary name.
  const CPLConfigOptionSetter no_sidecar("GDAL_PAM_ENABLED", "NO", false);
  CPLStringList options;
  options.SetNameValue("COMPRESS", "DEFLATE");
  options.SetNameValue("BIGTIFF", "IF_SAFER");
  bool ok = false;
  {
    const bool degrees = !raster.file_crs.empty();
    const GDALDatasetUniquePtr file = degrees ? create("MEM", "", raster, GDT_Float32, {})
                                              : create("GTiff", target->temporary(), raster, GDT_Float32, options);
    if (file) {
      describe(*file, raster, kNodata);
      ok = write_pixels(*file->GetRasterBand(1), raster,
                        [&](std::size_t k) { return raster.holes[k] ? kNodata : values[k]; });
    }
    if (ok && degrees)
      ok = reproject(*file, raster.file_crs, kNodata, "GTiff", target->temporary(), options) != nullptr;
  }
  if (!ok || session.failed()) return fail_write(path, session);
  return target->commit();
}

Result<void> write_png16(const std::string& path, const RasterView& raster) {
  DIVOT_ASSERT(raster.holes.size() == raster.heights.size());
  auto target = AtomicFile::create(path);
  if (!target) return tl::unexpected(target.error());
  auto sidecar = AtomicFile::adopt(path + ".aux.xml", target->temporary() + ".aux.xml");

  core::GdalSession session;
  const CPLConfigOptionSetter with_sidecar("GDAL_PAM_ENABLED", "YES", false);
  const Heights range = range_of(raster);
  const double step = range.high > range.low ? (range.high - range.low) / kSteps : 1;
  bool ok = false;
  {
    // GDAL writes PNG only as a copy of something whole.
    const GDALDatasetUniquePtr whole = create("MEM", "", raster, GDT_UInt16, {});
    GDALDriver* png = GetGDALDriverManager()->GetDriverByName("PNG");
    if (whole && png != nullptr) {
      describe(*whole, raster, 0);
      whole->GetRasterBand(1)->SetScale(step);
      whole->GetRasterBand(1)->SetOffset(range.low - step);
      ok = write_pixels(*whole->GetRasterBand(1), raster, [&](std::size_t k) {
        return raster.holes[k] ? 0.0f : static_cast<float>(1 + std::round((raster.heights[k] - range.low) / step));
      });
      const GDALDatasetUniquePtr file(
          ok ? png->CreateCopy(target->temporary().c_str(), whole.get(), FALSE, nullptr, nullptr, nullptr) : nullptr);
      ok = file != nullptr;
    }
  }
  if (!ok || session.failed()) return fail_write(path, session);
  // The sidecar first: a picture that is there can be read.
  if (auto placed = sidecar.commit(); !placed) return placed;
  return target->commit();
}

}  // namespace divot::output
