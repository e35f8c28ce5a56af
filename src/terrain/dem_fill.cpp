#include "terrain/dem_fill.h"

#include <fmt/format.h>
#include <gdal_alg.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/gdal.h"

namespace divot::terrain {
namespace {

// GDAL's view of an array of pixels.
template <class T>
GDALDatasetUniquePtr wrap(const DemPixels& pixels, std::vector<T>& values, GDALDataType type) {
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("MEM");
  if (driver == nullptr) return nullptr;
  GDALDatasetUniquePtr out(
      driver->Create("", static_cast<int>(pixels.columns), static_cast<int>(pixels.rows), 0, type, nullptr));
  CPLStringList options;
  options.SetNameValue("DATAPOINTER", fmt::format("{}", static_cast<void*>(values.data())).c_str());
  if (!out || out->AddBand(type, options.List()) != CE_None) return nullptr;
  return out;
}

}  // namespace

void fill_holes(DemPixels& pixels) {
  const core::GdalSession session;
  std::vector<std::uint8_t> known(pixels.height.size());
  for (std::size_t k = 0; k < known.size(); ++k) known[k] = !std::isnan(pixels.height[k]);
  if (std::ranges::all_of(known, [](std::uint8_t k) { return k != 0; })) return;
  std::vector<float> filled = pixels.height;
  const GDALDatasetUniquePtr heights = wrap(pixels, filled, GDT_Float32), mask = wrap(pixels, known, GDT_Byte);
  if (!heights || !mask) return;
  const double furthest = std::max(pixels.columns, pixels.rows);
  if (GDALFillNodata(heights->GetRasterBand(1), mask->GetRasterBand(1), furthest, 0, 0, nullptr, nullptr, nullptr) !=
      CE_None)
    return;
  pixels.height = std::move(filled);
}

}  // namespace divot::terrain
