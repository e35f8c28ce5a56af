#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "divot/views.h"
#include "viewer/camera.h"

namespace divot::viewer {

/// Faces sorted into cells, as rows: cell c holds faces[start[c]] to faces[start[c + 1]], ascending.
struct FaceRows {
  std::vector<std::uint32_t> start = {0}, faces;
  std::span<const std::uint32_t> row(std::size_t c) const {
    return std::span(faces).subspan(start[c], start[c + 1] - start[c]);
  }
  std::size_t size() const { return start.size() - 1; }
};

/// Which chunk draws each triangle of the ground: rectangles seen from above, by where a triangle's first corner lay
/// when the triangle came. Ids are not trusted to be near each other where the ground is.
class TerrainCells {
 public:
  /// [O(faces)]
  void build(const SurfaceView& surface, const Region& bounds);

  /// Takes over what has become of the triangles; cells that have become too full are halved, the new ones being the
  /// last. Returns for each cell whether its own triangles or its fringe are other ones. [O(faces + changed * cells)]
  std::vector<bool> follow(const SurfaceView& surface, const Topology& topology);

  std::size_t size() const { return cells_.size(); }
  /// Triangles of a cell.
  std::span<const std::uint32_t> own(std::size_t cell) const { return own_.row(cell); }
  /// Triangles of other cells that share a vertex with it.
  std::span<const std::uint32_t> fringe(std::size_t cell) const { return fringe_.row(cell); }

 private:
  struct Rectangle {
    double west, east, south, north;  // m, relative to the surface's origin
  };
  std::uint32_t find(const Vec3& p) const;
  void halve_full(const SurfaceView& surface, std::vector<bool>& changed);
  void list(const SurfaceView& surface);

  std::vector<Rectangle> cells_;
  std::vector<std::uint32_t> cell_of_;  // [face]
  FaceRows own_, fringe_;
};

}  // namespace divot::viewer
