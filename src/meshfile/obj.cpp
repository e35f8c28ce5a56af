#include <fmt/format.h>

#include "meshfile/mesh_file.h"
#include "meshfile/text.h"

namespace divot::meshfile {
namespace {

// `7`, `7/1`, `7//3`, or counted back from the last vertex, as `-1`: an index from 0.
bool vertex_of(std::string_view word, std::size_t count, std::uint32_t& vertex) {
  std::int64_t number = 0;
  if (!parse(word.substr(0, word.find('/')), number)) return false;
  const std::int64_t index = number < 0 ? static_cast<std::int64_t>(count) + number : number - 1;
  if (number == 0 || index < 0 || index >= static_cast<std::int64_t>(count)) return false;
  vertex = static_cast<std::uint32_t>(index);
  return true;
}

}  // namespace

Result<TriangleMesh> read_obj(const std::string& path, std::string_view bytes) {
  TriangleMesh mesh;
  std::vector<std::uint32_t> corners;
  for (Lines lines(bytes); lines.next();) {
    const std::string_view kind = lines.word();
    if (kind == "v") {
      Vec3d p;
      if (!parse(lines.word(), p.x) || !parse(lines.word(), p.y) || !parse(lines.word(), p.z))
        return refuse(path, lines.number(), "a vertex is not three numbers", "expected v X Y Z");
      mesh.vertices.push_back(p);
    } else if (kind == "f") {
      corners.clear();
      for (std::string_view word = lines.word(); !word.empty(); word = lines.word()) {
        std::uint32_t vertex = 0;
        if (!vertex_of(word, mesh.vertices.size(), vertex))
          return refuse(path, lines.number(), fmt::format("a face has the corner \"{}\"", word),
                        fmt::format("expected the number of a vertex above, 1 to {}", mesh.vertices.size()));
        corners.push_back(vertex);
      }
      if (corners.size() < 3)
        return refuse(path, lines.number(), fmt::format("a face has {} corners", corners.size()),
                      "expected at least 3");
      for (std::size_t k = 2; k < corners.size(); ++k)
        mesh.triangles.insert(mesh.triangles.end(), {corners[0], corners[k - 1], corners[k]});
    }
  }
  return mesh;
}

}  // namespace divot::meshfile
