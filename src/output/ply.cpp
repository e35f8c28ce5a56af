#include "output/ply.h"

#include <fmt/format.h>

#include "core/assert.h"
#include "output/packer.h"

namespace divot::output {
namespace {

std::string header(std::size_t vertices, std::size_t faces) {
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment metres, z up\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "property float sinkage\nproperty uchar material\n"
      "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      vertices, faces);
}

}  // namespace

Result<void> write_ply(const std::string& path, const SurfaceView& surface, std::span<const float> sinkage) {
  DIVOT_ASSERT(sinkage.size() == surface.positions.size() && surface.materials.size() == surface.positions.size());
  auto file = AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  file->write(header(surface.positions.size(), surface.triangles.size() / 3));
  {
    Packer packer(*file);
    for (std::size_t v = 0; v < surface.positions.size(); ++v) {
      const Vec3d p = to_double(surface.positions[v]) + surface.origin;
      packer.put(p.x), packer.put(p.y), packer.put(p.z);
      packer.put(sinkage[v]), packer.put(surface.materials[v]);
      packer.end_record();
    }
    for (std::size_t k = 0; k + 2 < surface.triangles.size(); k += 3) {
      packer.put(std::uint8_t{3});
      for (const std::size_t corner : {k, k + 1, k + 2}) packer.put(surface.triangles[corner]);
      packer.end_record();
    }
  }
  return file->commit();
}

}  // namespace divot::output
