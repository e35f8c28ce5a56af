#include "viewer/terrain_node.h"

#include <algorithm>
#include <cmath>

#include "divot/ids.h"

namespace divot::viewer {
namespace {

// Small chunks are cheap when one vertex in them moves, and dear as each is culled and drawn by a call of its own.
constexpr std::size_t kFewestTriangles = 512, kMostTriangles = 8192, kWantedChunks = 32;

// Faces sorted into square cells, as rows: cell c holds faces[start[c]] to faces[start[c + 1]].
struct Cells {
  std::vector<std::uint32_t> start, faces;
  std::span<const std::uint32_t> row(std::size_t c) const {
    return std::span(faces).subspan(start[c], start[c + 1] - start[c]);
  }
  std::size_t size() const { return start.size() - 1; }
};

// Rows from the cell of each entry. Entries keep their order within a row.
Cells gather(std::span<const std::uint32_t> cell_of, std::span<const std::uint32_t> face_of, std::size_t cell_count) {
  Cells cells{.start = std::vector<std::uint32_t>(cell_count + 1, 0), .faces = {}};
  for (const std::uint32_t cell : cell_of) ++cells.start[cell + 1];
  for (std::size_t c = 0; c < cell_count; ++c) cells.start[c + 1] += cells.start[c];
  std::vector<std::uint32_t> next(cells.start.begin(), cells.start.end() - 1);
  cells.faces.resize(cell_of.size());
  for (std::size_t i = 0; i < cell_of.size(); ++i) cells.faces[next[cell_of[i]]++] = face_of[i];
  return cells;
}

// The cell of each face by where its first corner lies. Ids are not trusted to be near each other where the ground is.
std::vector<std::uint32_t> assign_cells(const SurfaceView& surface, const Region& bounds, std::size_t& cell_count) {
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

  std::vector<std::uint32_t> cells(faces);
  for (std::size_t f = 0; f < faces; ++f) {
    const Vec3d p = to_double(surface.positions[surface.triangles[3 * f]]) + surface.origin - bounds.min;
    cells[f] = index(p.y, deep, rows) * columns + index(p.x, wide, columns);
  }
  cell_count = static_cast<std::size_t>(columns) * rows;
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
Cells fringes(const SurfaceView& surface, std::span<const std::uint32_t> cell_of, std::size_t cell_count) {
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

}  // namespace

TerrainNode::TerrainNode() : ground_(new osg::Group), mesh_(new osg::Group), walls_(new osg::Group) {}

void TerrainNode::update(const SurfaceView& surface, std::span<const DirtyRange> dirty, const Sinkage& sinkage) {
  if (surface.positions.size() != vertex_count_ || surface.triangles.size() != corner_count_) {
    return rebuild(surface, sinkage);
  }
  bool any_cut = false;
  for (TerrainChunk& chunk : chunks_) {
    if (!chunk.touches(dirty)) continue;
    const bool cut = chunk.cut_again(surface);
    const std::size_t moved = chunk.refresh(surface, sinkage);
    uploaded_bytes_ += cut ? chunk.size_bytes() : moved;
    largest_sinkage_ = std::max(largest_sinkage_, chunk.largest_sinkage());
    any_cut |= cut;
  }
  if (any_cut) list_parts();
}

// Hangs what the chunks draw below the groups that are drawn. [O(chunks)]
void TerrainNode::list_parts() {
  ground_->removeChildren(0, ground_->getNumChildren());
  ground_materials_.clear();
  mesh_->removeChildren(0, mesh_->getNumChildren());
  walls_->removeChildren(0, walls_->getNumChildren());
  for (TerrainChunk& chunk : chunks_) {
    for (const ChunkPart& part : chunk.parts()) {
      if (part.material < looks_.size()) part.ground->setStateSet(looks_[part.material]);
      ground_->addChild(part.ground);
      ground_materials_.push_back(part.material);
    }
    mesh_->addChild(&chunk.mesh());
    if (chunk.wall()) walls_->addChild(chunk.wall());
  }
}

void TerrainNode::mark_awake(std::span<const std::uint32_t> awake) {
  for (TerrainChunk& chunk : chunks_) uploaded_bytes_ += chunk.mark_awake(awake);
}

std::uint64_t TerrainNode::size_bytes() const {
  std::uint64_t sum = 0;
  for (const TerrainChunk& chunk : chunks_) sum += chunk.size_bytes();
  return sum;
}

void TerrainNode::rebuild(const SurfaceView& surface, const Sinkage& sinkage) {
  measure(surface, sinkage);
  largest_sinkage_ = 0;
  chunks_.clear();
  vertex_count_ = surface.positions.size();
  corner_count_ = surface.triangles.size();

  std::size_t cell_count = 0;
  const std::vector<std::uint32_t> cell_of = assign_cells(surface, bounds_, cell_count);
  std::vector<std::uint32_t> all(cell_of.size());
  for (std::size_t f = 0; f < all.size(); ++f) all[f] = static_cast<std::uint32_t>(f);
  const Cells own = gather(cell_of, all, cell_count), fringe = fringes(surface, cell_of, cell_count);

  Region original = bounds_;
  original.min.z = lowest_ + surface.origin.z;
  const auto base = static_cast<float>(block_base(original) - surface.origin.z);
  for (std::size_t cell = 0; cell < own.size(); ++cell) {
    if (own.row(cell).empty()) continue;
    TerrainChunk& chunk = chunks_.emplace_back(surface, own.row(cell), fringe.row(cell), base);
    chunk.refresh(surface, sinkage);
    largest_sinkage_ = std::max(largest_sinkage_, chunk.largest_sinkage());
    uploaded_bytes_ += chunk.size_bytes();
  }
  list_parts();
}

void TerrainNode::measure(const SurfaceView& surface, const Sinkage& sinkage) {
  bounds_ = terrain_bounds(surface);
  if (surface.triangles.empty()) return;
  const auto original_height = [&](std::uint32_t v) { return surface.positions[v].z + (sinkage ? sinkage(v) : 0.0f); };
  lowest_ = highest_ = original_height(surface.triangles.front());
  for (const std::uint32_t vertex : surface.triangles) {
    lowest_ = std::min(lowest_, original_height(vertex));
    highest_ = std::max(highest_, original_height(vertex));
  }
}

}  // namespace divot::viewer
