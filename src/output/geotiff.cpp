#include "output/geotiff.h"

#include <cpl_conv.h>

#include <array>
#include <vector>

#include "core/assert.h"
#include "core/gdal.h"
#include "output/atomic_file.h"

namespace divot::output {
namespace {

GDALDatasetUniquePtr create(const std::string& path, const RasterView& raster) {
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  if (driver == nullptr) return nullptr;
  CPLStringList options;
  options.SetNameValue("COMPRESS", "DEFLATE");
  options.SetNameValue("BIGTIFF", "IF_SAFER");
  return GDALDatasetUniquePtr(driver->Create(path.c_str(), static_cast<int>(raster.columns),
                                             static_cast<int>(raster.rows), 1, GDT_Float32, options.List()));
}

// Where the pixels lie and what they mean.
void describe(GDALDataset& file, const RasterView& raster) {
  // GDAL counts from the outer corner of the first pixel, we from its centre.
  std::array<double, 6> transform{raster.x0 - raster.dx / 2, raster.dx, 0, raster.y0 + raster.dy / 2, 0, -raster.dy};
  file.SetGeoTransform(transform.data());
  if (!raster.crs.empty()) file.SetProjection(raster.crs.c_str());
  file.GetRasterBand(1)->SetNoDataValue(kNodata);
  file.GetRasterBand(1)->SetUnitType("m");
}

bool write_heights(GDALRasterBand& band, const RasterView& raster) {
  std::vector<float> line(raster.columns);
  for (std::uint32_t row = 0; row < raster.rows; ++row) {
    const std::size_t first = static_cast<std::size_t>(row) * raster.columns;
    for (std::uint32_t column = 0; column < raster.columns; ++column)
      line[column] = raster.holes[first + column] ? kNodata : raster.heights[first + column];
    const int columns = static_cast<int>(raster.columns);
    if (band.RasterIO(GF_Write, 0, static_cast<int>(row), columns, 1, line.data(), columns, 1, GDT_Float32, 0, 0,
                      nullptr) != CE_None) {
      return false;
    }
  }
  return true;
}

}  // namespace

Result<void> write_geotiff(const std::string& path, const RasterView& raster) {
  DIVOT_ASSERT(raster.heights.size() == static_cast<std::size_t>(raster.columns) * raster.rows);
  DIVOT_ASSERT(raster.holes.size() == raster.heights.size());
  auto target = AtomicFile::create(path);
  if (!target) return tl::unexpected(target.error());

  // The file is flushed when it is closed, and that has no status of its own: the session hears what goes wrong.
  core::GdalSession session;
  // What a TIFF cannot say of a rare coordinate system would go to a second file, under the temporary name.
  const CPLConfigOptionSetter no_sidecar("GDAL_PAM_ENABLED", "NO", false);
  bool ok = false;
  {
    const GDALDatasetUniquePtr file = create(target->temporary(), raster);
    if (file) {
      describe(*file, raster);
      ok = write_heights(*file->GetRasterBand(1), raster);
    }
  }
  if (!ok || session.failed()) {
    Error error;
    error.file = path;
    error.problem = "cannot be written: " + session.message("no reason given");
    return fail(std::move(error));
  }
  return target->commit();
}

}  // namespace divot::output
