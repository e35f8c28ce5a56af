#include "viewer/terrain_cells.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "divot/ids.h"

namespace divot::viewer {
namespace {

// Small chunks are cheap when one vertex in them moves, and dear as each is culled and drawn by a call of its own.
constexpr std::size_t kFewestTriangles = 512, kMostTriangles = 8192, kWantedChunks = 32;

// Rows from the cell of each entry. Entries keep their order within a row.
FaceRows gather(std::span<const std::uint32_t> cell_of, std::span<const std::uint32_t> face_of,
                std::size_t cell_count) {
  FaceRows cells{.start = std::vector<std::uint32_t>(cell_count + 1, 0), .faces = {}};
  for (const std::uint32_t cell : cell_of) ++cells.start[cell + 1];
  for (std::size_t c = 0; c < cell_count; ++c) cells.start[c + 1] += cells.start[c];
  std::vector<std::uint32_t> next(cells.start.begin(), cells.start.end() - 1);
  cells.faces.resize(cell_of.size());
  for (std::size_t i = 0; i < cell_of.size(); ++i) cells.faces[next[cell_of[i]]++] = face_of[i];
  return cells;
}

constexpr std::uint32_t kManyCells = kNone - 1;

// Which cell's faces use each vertex: kNone for none, kManyCells where cells meet.
std::vector<std::uint32_t> vertex_cells(const SurfaceView& surface, std::span<const std::uint32_t> cell_of) {
  std::vector<std::uint32_t> owner(surface.positions.size(), kNone);
  for (std::size_t c = 0; c < surface.triangles.size(); ++c) {
    std::uint32_t& cell = owner[surface.triangles[c]];
    cell = cell == kNone || cell == cell_of[c / 3] ? cell_of[c / 3] : kManyCells;
  }
  return owner;
}

// For each cell the faces of others that share a vertex with it. Only faces at vertices where cells meet are looked at.
FaceRows fringes(const SurfaceView& surface, std::span<const std::uint32_t> cell_of, std::size_t cell_count) {
  const std::vector<std::uint32_t> owner = vertex_cells(surface, cell_of);
  using Use = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Use> uses;  // (shared vertex, face), ascending
  for (std::size_t c = 0; c < surface.triangles.size(); ++c) {
    const std::uint32_t vertex = surface.triangles[c];
    if (owner[vertex] == kManyCells) uses.emplace_back(vertex, static_cast<std::uint32_t>(c / 3));
  }
  std::sort(uses.begin(), uses.end());

  std::vector<Use> foreign;  // (cell, face of another cell)
  for (auto first = uses.begin(); first != uses.end();) {
    const auto last = std::find_if(first, uses.end(), [&](const Use& use) { return use.first != first->first; });
    for (auto a = first; a != last; ++a) {
      for (auto b = first; b != last; ++b) {
        if (cell_of[a->second] != cell_of[b->second]) foreign.emplace_back(cell_of[a->second], b->second);
      }
    }
    first = last;
  }
  std::sort(foreign.begin(), foreign.end());
  foreign.erase(std::unique(foreign.begin(), foreign.end()), foreign.end());

  std::vector<std::uint32_t> cells(foreign.size()), faces(foreign.size());
  for (std::size_t i = 0; i < foreign.size(); ++i) std::tie(cells[i], faces[i]) = foreign[i];
  return gather(cells, faces, cell_count);
}

Vec3 first_corner(const SurfaceView& surface, std::size_t face) {
  return surface.positions[surface.triangles[3 * face]];
}

}  // namespace

void TerrainCells::build(const SurfaceView& surface, const Region& bounds) {
  const std::size_t faces = surface.triangles.size() / 3;
  const double wide = bounds.max.x - bounds.min.x, deep = bounds.max.y - bounds.min.y;
  const std::size_t size = std::clamp(faces / kWantedChunks, kFewestTriangles, kMostTriangles);
  const double wanted = std::max(1.0, std::round(static_cast<double>(faces) / static_cast<double>(size)));
  const double cell = std::sqrt(std::max(wide * deep, 1e-12) / wanted);
  const auto columns = static_cast<std::uint32_t>(std::clamp(std::ceil(wide / cell - 1e-6), 1.0, wanted));
  const auto rows = static_cast<std::uint32_t>(std::clamp(std::ceil(deep / cell - 1e-6), 1.0, wanted));
  const auto index = [](double along, double length, std::uint32_t count) {
    return length > 0 ? std::min(count - 1, static_cast<std::uint32_t>(std::max(0.0, along / length * count))) : 0u;
  };

  const double west = bounds.min.x - surface.origin.x, south = bounds.min.y - surface.origin.y;
  cells_.clear();
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c)
      cells_.push_back({west + wide * c / columns, west + wide * (c + 1) / columns, south + deep * r / rows,
                        south + deep * (r + 1) / rows});
  cell_of_.resize(faces);
  for (std::size_t f = 0; f < faces; ++f) {
    const Vec3d p = to_double(first_corner(surface, f));
    cell_of_[f] = index(p.y - south, deep, rows) * columns + index(p.x - west, wide, columns);
  }
  list(surface);
}

// Faces that lie beside all cells belong to the nearest. [O(cells)]
std::uint32_t TerrainCells::find(const Vec3& p) const {
  const auto outside = [&](const Rectangle& r) {
    const double x = std::max({r.west - p.x, p.x - r.east, 0.0}), y = std::max({r.south - p.y, p.y - r.north, 0.0});
    return x + y;
  };
  const auto nearest = std::min_element(
      cells_.begin(), cells_.end(), [&](const Rectangle& a, const Rectangle& b) { return outside(a) < outside(b); });
  return static_cast<std::uint32_t>(nearest - cells_.begin());
}

// Halves cells that hold more than a chunk should, across their longer side.
void TerrainCells::halve_full(const SurfaceView& surface, std::vector<bool>& changed) {
  std::vector<std::size_t> count(cells_.size(), 0);
  for (const std::uint32_t cell : cell_of_) ++count[cell];
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
    if (count[cell] <= kMostTriangles) continue;
    Rectangle& low = cells_[cell];
    Rectangle high = low;
    const bool along_x = low.east - low.west > low.north - low.south;
    (along_x ? low.east : low.north) = (along_x ? high.west : high.south) =
        along_x ? (low.west + low.east) / 2 : (low.south + low.north) / 2;
    const double cut = along_x ? low.east : low.north;
    const auto fresh = static_cast<std::uint32_t>(cells_.size());
    cells_.push_back(high), count.push_back(0), changed.push_back(true);
    changed[cell] = true;
    for (std::size_t f = 0; f < cell_of_.size(); ++f) {
      if (cell_of_[f] != cell) continue;
      const Vec3 p = first_corner(surface, f);
      if ((along_x ? p.x : p.y) < cut) continue;
      cell_of_[f] = fresh;
      --count[cell], ++count[fresh];
    }
    // Once more where that was not enough, unless all lie in one place.
    if (count[cell] > kMostTriangles && count[fresh] > 0) --cell;
  }
}

std::vector<bool> TerrainCells::follow(const SurfaceView& surface, const Topology& topology) {
  const std::size_t before = cell_of_.size(), faces = surface.triangles.size() / 3;
  std::vector<bool> changed(cells_.size(), false), other(faces, false);
  const std::vector<std::uint32_t> old_cell = cell_of_;
  cell_of_.resize(faces, kNone);
  for (const auto& [first, last] : topology.triangles)
    for (std::size_t f = first; f < last; ++f) {
      if (f < before) changed[old_cell[f]] = true;
      if (f >= faces) continue;
      cell_of_[f] = find(first_corner(surface, f));
      changed[cell_of_[f]] = true;
      other[f] = true;
    }
  halve_full(surface, changed);
  const FaceRows fringe_before = std::exchange(fringe_, {});
  list(surface);
  for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
    const auto now = fringe_.row(cell);
    const bool same = cell < fringe_before.size() && std::ranges::equal(now, fringe_before.row(cell)) &&
                      std::ranges::none_of(now, [&](std::uint32_t f) { return other[f]; });
    if (!same) changed[cell] = true;
  }
  return changed;
}

void TerrainCells::list(const SurfaceView& surface) {
  std::vector<std::uint32_t> all(cell_of_.size());
  for (std::size_t f = 0; f < all.size(); ++f) all[f] = static_cast<std::uint32_t>(f);
  own_ = gather(cell_of_, all, cells_.size());
  fringe_ = fringes(surface, cell_of_, cells_.size());
}

}  // namespace divot::viewer
