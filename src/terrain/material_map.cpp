#include "terrain/material_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "core/assert.h"
#include "core/gdal.h"
#include "terrain/map_file.h"

namespace divot::terrain {
namespace {

std::uint8_t index_of(std::span<const Material> materials, const std::string& name) {
  const auto at = std::ranges::find(materials, name, &Material::name);
  DIVOT_ASSERT(at != materials.end());
  return static_cast<std::uint8_t>(at - materials.begin());
}

struct Extent {
  double west = 0, east = 0, south = 0, north = 0;
};

// What the surface covers, in the terrain's coordinates: the vertices' own cells of a grid, and a mesh from end to end.
Extent extent_of(const state::Surface& surface) {
  if (const auto& raster = surface.raster) {
    const double width = raster->dx * raster->layout.columns, height = raster->dy * raster->layout.rows;
    const double west = raster->x0 - raster->dx / 2, south = raster->y0 - raster->dy / 2;
    return {west, west + width, south, south + height};
  }
  const Vec3d first = to_double(surface.position.front()) + surface.origin;
  Extent e{first.x, first.x, first.y, first.y};
  for (const Vec3& local : surface.position) {
    const Vec3d p = to_double(local) + surface.origin;
    e.west = std::min(e.west, p.x), e.east = std::max(e.east, p.x);
    e.south = std::min(e.south, p.y), e.north = std::max(e.north, p.y);
  }
  return e;
}

// From the terrain's coordinates to columns and rows of the map.
struct Placement {
  std::unique_ptr<OGRCoordinateTransformation> to_map;  // null: the same coordinates
  std::array<double, 6> to_pixel{};
  bool stretched = false;
};

Placement stretch(const Extent& e, const MapPixels& pixels) {
  Placement out{.to_map = nullptr, .to_pixel = {}, .stretched = true};
  const double columns = pixels.columns / (e.east - e.west), rows = pixels.rows / (e.north - e.south);
  out.to_pixel = {-e.west * columns, columns, 0, e.north * rows, 0, -rows};
  return out;
}

Result<Placement> place(const MaterialMap& map, MapPixels& pixels, const state::Surface& surface) {
  if (!pixels.transform) return stretch(extent_of(surface), pixels);
  Placement out;
  if (GDALInvGeoTransform(pixels.transform->data(), out.to_pixel.data()) == 0)
    return fail(map_error(map, "its pixels have no size", "expected a raster with square metres"));
  const std::string own = surface.raster ? surface.raster->crs : std::string();
  if (pixels.crs.IsEmpty() || own.empty()) return out;  // neither says that they differ
  const core::GdalSession session;
  OGRSpatialReference terrain;
  terrain.importFromWkt(own.c_str());
  terrain.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (terrain.IsSame(&pixels.crs)) return out;
  out.to_map.reset(OGRCreateCoordinateTransformation(&terrain, &pixels.crs));
  if (out.to_map) return out;
  return fail(map_error(map, "cannot be laid over the terrain (" + session.message("no transformation") + ")",
                        "expected a coordinate system that the terrain's can be brought to"));
}

// The pixel's entry at a place in columns and rows.
std::uint8_t entry_at(const MapPixels& pixels, const Placement& placement, double x, double y) {
  const auto& t = placement.to_pixel;
  double column = std::floor(t[0] + x * t[1] + y * t[2]), row = std::floor(t[3] + x * t[4] + y * t[5]);
  if (placement.stretched) {  // rounding must not push the outermost vertices out
    column = std::clamp(column, 0.0, pixels.columns - 1.0), row = std::clamp(row, 0.0, pixels.rows - 1.0);
  }
  if (!(column >= 0 && column < pixels.columns && row >= 0 && row < pixels.rows)) return MapPixels::kNoEntry;
  return pixels.entry[static_cast<std::size_t>(row) * pixels.columns + static_cast<std::size_t>(column)];
}

Error beside(const MaterialMap& map, const MapPixels& pixels, const state::Surface& surface) {
  const Extent e = extent_of(surface);
  const auto& t = *pixels.transform;
  return map_error(map,
                   fmt::format("lies beside the terrain: x from {:g} to {:g}, y from {:g} to {:g}, where the terrain "
                               "has x from {:g} to {:g}, y from {:g} to {:g}",
                               t[0], t[0] + pixels.columns * t[1], std::min(t[3], t[3] + pixels.rows * t[5]),
                               std::max(t[3], t[3] + pixels.rows * t[5]), e.west, e.east, e.south, e.north),
                   "expected coordinates of the terrain, or material_map.crs to say what they are");
}

Result<void> apply(const MaterialMap& map, const Placement& placement, const MapPixels& pixels,
                   const std::vector<std::uint8_t>& material, state::Surface& surface) {
  constexpr std::size_t kBatch = 4096;
  std::vector<double> x, y;
  bool any = false;
  for (std::size_t first = 0; first < surface.position.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, surface.position.size() - first);
    x.resize(count), y.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const Vec3d p = to_double(surface.position[first + k]) + surface.origin;
      x[k] = p.x, y[k] = p.y;
    }
    // What cannot be transformed becomes infinite, and so lies outside.
    if (placement.to_map) placement.to_map->Transform(static_cast<int>(count), x.data(), y.data());
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint8_t entry = entry_at(pixels, placement, x[k], y[k]);
      if (entry == MapPixels::kNoEntry) continue;
      surface.material[first + k] = material[entry];
      any = true;
    }
  }
  return any ? Result<void>() : fail(beside(map, pixels, surface));
}

// A map that has been read, where it lies, and what its entries are.
struct PlacedMap {
  MaterialMap map;
  MapPixels pixels;
  Placement placement;
  std::vector<std::uint8_t> material;  // [entry]
};

Result<PlacedMap> read_placed(const Scene& scene, std::span<const Material> materials, const state::Surface& surface) {
  // An absolute path stays as it is: joining replaces the folder.
  MaterialMap map = scene.terrain.material_map;
  map.image = (std::filesystem::path(scene.folder) / map.image).string();
  if (const auto* dem = std::get_if<DemTerrain>(&scene.terrain.shape); dem != nullptr && map.crs.empty())
    map.crs = dem->crs;
  auto pixels = read_map(map, scene.terrain.max_vertices);
  if (!pixels) return tl::unexpected(pixels.error());
  auto placement = place(map, *pixels, surface);
  if (!placement) return tl::unexpected(placement.error());
  PlacedMap placed{std::move(map), std::move(*pixels), std::move(*placement), {}};
  for (const LegendEntry& entry : placed.map.legend) placed.material.push_back(index_of(materials, entry.material));
  return placed;
}

Result<void> apply_map(const Scene& scene, std::span<const Material> materials, state::Surface& surface) {
  const auto placed = read_placed(scene, materials, surface);
  if (!placed) return tl::unexpected(placed.error());
  return apply(placed->map, placed->placement, placed->pixels, placed->material, surface);
}

}  // namespace

Result<void> place_materials(const Scene& scene, std::span<const Material> materials, state::Surface& surface) {
  surface.material.assign(surface.position.size(), index_of(materials, scene.terrain.material));
  if (!scene.terrain.material_map.legend.empty()) return apply_map(scene, materials, surface);
  if (const auto* mesh = std::get_if<MeshTerrain>(&scene.terrain.shape); mesh != nullptr && !mesh->materials.empty()) {
    for (std::size_t v = 0; v < mesh->materials.size(); ++v)
      surface.material[v] = index_of(materials, scene.materials[mesh->materials[v]].name);
    for (std::size_t k = 0; k < surface.rigid.copies.size(); ++k)
      surface.material[surface.rigid.first_copy + k] = surface.material[surface.rigid.copies[k]];
  }
  return {};
}

Result<MaterialAt> material_between(const Scene& scene, std::span<const Material> materials,
                                    const state::Surface& surface) {
  if (scene.terrain.material_map.legend.empty()) return MaterialAt();
  auto placed = read_placed(scene, materials, surface);
  if (!placed) return tl::unexpected(placed.error());
  return [map = std::make_shared<const PlacedMap>(std::move(*placed)),
          otherwise = index_of(materials, scene.terrain.material)](double x, double y) {
    if (map->placement.to_map && map->placement.to_map->Transform(1, &x, &y) == 0) return otherwise;
    const std::uint8_t entry = entry_at(map->pixels, map->placement, x, y);
    return entry == MapPixels::kNoEntry ? otherwise : map->material[entry];
  };
}

}  // namespace divot::terrain
