#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "divot/errors.h"
#include "divot/vec.h"

namespace divot::meshfile {

/// Triangles as a file has them, in its own units and axes; glTF, which is y up, is turned to z up.
struct TriangleMesh {
  std::vector<Vec3d> vertices;
  std::vector<std::uint32_t> triangles;  ///< [3 * face] indices below vertices.size(), in the file's winding
};

/// Reads OBJ, PLY (text, binary of both byte orders), STL (text, binary) or glTF 2.0 (.gltf, .glb); which one says the
/// name's ending. Polygons become fans. Where a format cannot say that triangles share a vertex (STL) or splits
/// vertices for other reasons (glTF), equal positions are joined. Coordinates are finite and indices in range in what
/// it returns. Fails naming the file and, for text, the line. Memory is bounded by the file's size. [O(size log size)]
Result<TriangleMesh> read_mesh(const std::string& path);

/// Does the name say that the file is glTF, whose axes are known?
bool is_gltf(const std::string& path);

// The formats, from the bytes of a file; `path` is for errors, and glTF's buffers lie beside it.
Result<TriangleMesh> read_obj(const std::string& path, std::string_view bytes);
Result<TriangleMesh> read_ply(const std::string& path, std::string_view bytes);
Result<TriangleMesh> read_stl(const std::string& path, std::string_view bytes);
Result<TriangleMesh> read_gltf(const std::string& path, std::string_view bytes);

/// A whole file. Fails with the system's reason.
Result<std::string> read_bytes(const std::string& path);

/// Joins vertices at equal positions, keeping the first of each, and drops triangles that lose a corner by it.
/// [O(n log n)]
void join_equal_vertices(TriangleMesh& mesh);

}  // namespace divot::meshfile
