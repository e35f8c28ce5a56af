#include "terrain/terrain.h"

#include <filesystem>

#include "core/hash.h"
#include "terrain/dem.h"
#include "terrain/grid.h"
#include "terrain/mesh.h"
#include "terrain/mesh_file.h"

namespace divot::terrain {

Result<state::Surface> load_terrain(const Scene& scene) {
  if (const auto* grid = std::get_if<GridTerrain>(&scene.terrain.shape)) {
    return load_grid(*grid, scene.terrain.max_vertices);
  }
  if (const auto* mesh = std::get_if<MeshTerrain>(&scene.terrain.shape)) {
    if (mesh->path.empty()) return load_mesh(*mesh, scene.terrain.max_vertices);
    return load_mesh_file(*mesh, scene.folder, scene.terrain.max_vertices);
  }
  // An absolute path stays as it is: joining replaces the folder.
  DemTerrain dem = std::get<DemTerrain>(scene.terrain.shape);
  dem.path = (std::filesystem::path(scene.folder) / dem.path).string();
  return load_dem(dem, scene.terrain.max_vertices);
}

std::uint64_t fingerprint(const state::Surface& surface) {
  core::Hash hash;
  for (const Vec3& p : surface.position) hash.add(p.x), hash.add(p.y), hash.add(p.z);
  for (const std::uint32_t vertex : surface.mesh.triangles()) hash.add(static_cast<std::uint64_t>(vertex));
  for (const std::uint32_t vertex : surface.rigid.triangles) hash.add(static_cast<std::uint64_t>(vertex));
  for (const std::uint8_t material : surface.material) hash.add(static_cast<std::uint64_t>(material));
  for (const double number : {surface.origin.x, surface.origin.y, surface.origin.z}) hash.add(number);
  return hash.value();
}

}  // namespace divot::terrain
