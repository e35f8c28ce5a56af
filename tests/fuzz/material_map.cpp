// Any bytes as the picture of a material map: read, every pixel with an entry of the legend, or refused with a reason.
#include <cpl_vsi.h>

#include <cstdint>
#include <cstdlib>

#include "terrain/map_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr const char* kFile = "/vsimem/map";
  // GDAL only reads.
  VSILFILE* file = VSIFileFromMemBuffer(kFile, const_cast<GByte*>(data), size, FALSE);
  if (file == nullptr) std::abort();
  VSIFCloseL(file);
  const divot::MaterialMap map{.image = kFile,
                               .legend = {{.pixel = 0, .material = "mud"}, {.pixel = 255, .material = "asphalt"}}};
  const auto pixels = divot::terrain::read_map(map, 1 << 20);
  if (!pixels && pixels.error().empty()) std::abort();
  if (pixels)
    for (const std::uint8_t entry : pixels->entry)
      if (entry >= map.legend.size() && entry != divot::terrain::MapPixels::kNoEntry) std::abort();
  VSIUnlink(kFile);
  return 0;
}
