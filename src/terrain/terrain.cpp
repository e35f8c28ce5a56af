#include "terrain/terrain.h"

#include <filesystem>

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

}  // namespace divot::terrain
