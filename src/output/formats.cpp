#include "output/formats.h"

#include <algorithm>
#include <array>

#include "core/assert.h"
#include "output/csv.h"
#include "output/gltf.h"
#include "output/obj.h"
#include "output/ply.h"
#include "output/raster_file.h"
#include "output/vtp.h"

namespace divot::output {
namespace {

constexpr std::array kFormats{
    Format{.name = "ply",
           .meaning = "binary triangle mesh with sinkage and material",
           .write = [](const std::string& path, const Frame& f) { return write_ply(path, f.surface(), f.sinkage); }},
    Format{.name = "obj",
           .meaning = "triangle mesh as text (Wavefront)",
           .write = [](const std::string& path, const Frame& f) { return write_obj(path, f.surface()); }},
    Format{.name = "glb",
           .meaning = "triangle mesh as binary glTF 2.0, y up, with sinkage as colours and as `_SINKAGE`; "
                      "`extras.origin` of its node is what to add for the terrain's coordinates",
           .write = [](const std::string& path, const Frame& f) { return write_glb(path, f.surface(), f.sinkage); }},
    Format{.name = "vtp",
           .meaning = "mesh for ParaView (VTK) with sinkage, material, velocity, awake and pressure",
           .write = write_vtp,
           .series_name = "frames.pvd",
           .write_series = write_pvd},
    Format{.name = "csv",
           .meaning = "a row for each vertex: x, y, z, sinkage, material",
           .write = [](const std::string& path,
                       const Frame& f) { return write_surface_csv(path, f.surface(), f.sinkage); }},
    Format{.name = "tif",
           .meaning = "GeoTIFF of height in the coordinates of the terrain, of a `dem` in degrees in the DEM's own",
           .raster = true,
           .write = [](const std::string& path,
                       const Frame& f) { return write_geotiff(path, *f.raster, f.raster->heights); }},
    Format{.name = "change.tif",
           .meaning = "GeoTIFF of height less the height at the start",
           .raster = true,
           .write = [](const std::string& path,
                       const Frame& f) { return write_geotiff(path, *f.raster, f.raster->change); }},
    Format{.name = "sinkage.tif",
           .meaning = "GeoTIFF of how far the soil that is there has sunk since the start",
           .raster = true,
           .write = [](const std::string& path,
                       const Frame& f) { return write_geotiff(path, *f.raster, f.raster->sinkage); }},
    Format{.name = "height.png",
           .meaning = "16-bit grey PNG of height for game engines, 1 lowest, 65535 highest, 0 no data; scale, offset "
                      "and place in `.aux.xml` beside it, where GDAL finds them",
           .raster = true,
           .write = [](const std::string& path, const Frame& f) { return write_png16(path, *f.raster); }},
};

constexpr auto kNames = [] {
  std::array<const char*, kFormats.size()> names{};
  for (std::size_t k = 0; k < names.size(); ++k) names[k] = kFormats[k].name;
  return names;
}();

}  // namespace

std::span<const Format> formats() { return kFormats; }

std::span<const char* const> format_names() { return kNames; }

const Format& format(std::string_view name) {
  const auto found = std::ranges::find(kFormats, name, &Format::name);
  DIVOT_ASSERT(found != kFormats.end());
  return *found;
}

}  // namespace divot::output
