#include <fmt/format.h>

#include <array>
#include <cstring>

#include "meshfile/mesh_file.h"
#include "meshfile/text.h"

namespace divot::meshfile {
namespace {

constexpr std::size_t kHeader = 84, kRecord = 50;  // 80 bytes and a count; a normal, three corners, two bytes

// Corners one after the other, three a triangle.
TriangleMesh joined(std::vector<Vec3d> corners) {
  TriangleMesh mesh{std::move(corners), {}};
  for (std::uint32_t k = 0; k < mesh.vertices.size(); ++k) mesh.triangles.push_back(k);
  join_equal_vertices(mesh);
  return mesh;
}

Result<TriangleMesh> binary(const std::string& path, std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= kHeader) std::memcpy(&count, bytes.data() + 80, sizeof count);
  if (bytes.size() < kHeader || (bytes.size() - kHeader) / kRecord < count)
    return refuse(path, 0, fmt::format("{} bytes hold no STL of {} triangles", bytes.size(), count),
                  "expected a whole file");
  std::vector<Vec3d> corners;
  corners.reserve(std::size_t{3} * count);
  for (std::size_t t = 0; t < count; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<float, 3> p;
      std::memcpy(p.data(), bytes.data() + kHeader + t * kRecord + 12 + 12 * k, sizeof p);
      corners.push_back({p[0], p[1], p[2]});
    }
  return joined(std::move(corners));
}

Result<TriangleMesh> text(const std::string& path, std::string_view bytes) {
  std::vector<Vec3d> corners;
  Lines lines(bytes);
  while (lines.next()) {
    if (lines.word() != "vertex") continue;
    Vec3d p;
    if (!parse(lines.word(), p.x) || !parse(lines.word(), p.y) || !parse(lines.word(), p.z))
      return refuse(path, lines.number(), "a vertex is not three numbers", "expected vertex X Y Z");
    corners.push_back(p);
  }
  if (corners.size() % 3 != 0)
    return refuse(path, lines.number(), fmt::format("ends after {} vertices", corners.size()),
                  "expected three a facet");
  return joined(std::move(corners));
}

}  // namespace

Result<TriangleMesh> read_stl(const std::string& path, std::string_view bytes) {
  // Some binary files begin with "solid" too, but they hold no facets in words.
  const bool words = bytes.starts_with("solid") && bytes.substr(0, 2000).find("facet") != bytes.npos;
  return words ? text(path, bytes) : binary(path, bytes);
}

}  // namespace divot::meshfile
