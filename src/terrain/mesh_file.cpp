#include "terrain/mesh_file.h"

#include <filesystem>

#include "meshfile/mesh_file.h"
#include "terrain/mesh.h"

namespace divot::terrain {
namespace {

tl::unexpected<Errors> about(const std::string& path, Errors errors) {
  for (Error& error : errors) error.file = path, error.key = "terrain.mesh";
  return tl::unexpected(std::move(errors));
}

}  // namespace

Result<state::Surface> load_mesh_file(const MeshTerrain& mesh, const std::string& folder, std::uint64_t max_vertices) {
  // An absolute path stays as it is: joining replaces the folder.
  const std::string path = (std::filesystem::path(folder) / mesh.path).string();
  auto read = meshfile::read_mesh(path);
  if (!read) return about(path, std::move(read.error()));
  const bool turn = mesh.up == UpAxis::y && !meshfile::is_gltf(path);
  for (Vec3d& p : read->vertices) p = mesh.scale * (turn ? Vec3d{p.x, -p.z, p.y} : p);
  auto surface =
      load_mesh({.vertices = std::move(read->vertices), .triangles = std::move(read->triangles)}, max_vertices);
  if (!surface) return about(path, std::move(surface.error()));
  return surface;
}

}  // namespace divot::terrain
