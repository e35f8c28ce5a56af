#include "viewer/terrain_chunk.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "divot/ids.h"
#include "viewer/color_scale.h"

namespace divot::viewer {
namespace {

// What moves of a vertex: position, normal, sinkage.
constexpr std::size_t kVertex = 2 * sizeof(osg::Vec3) + sizeof(osg::Vec2);

osg::ref_ptr<osg::Geometry> make_geometry(osg::Vec3Array& positions, osg::Vec3Array& normals, osg::Vec2Array& depth) {
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setDataVariance(osg::Object::DYNAMIC);
  geometry->setUseDisplayList(false);
  geometry->setUseVertexBufferObjects(true);
  geometry->setVertexArray(&positions);
  geometry->setNormalArray(&normals, osg::Array::BIND_PER_VERTEX);
  geometry->setVertexAttribArray(kSinkageAttribute, &depth, osg::Array::BIND_PER_VERTEX);
  return geometry;
}

// Edges of the first `own_count` triangles that no other triangle shares, as pairs of vertices in the triangle's
// direction. Directed edges are bucketed by their smaller vertex, so that only the few at one vertex are compared.
std::vector<std::uint32_t> border_edges(const std::vector<std::uint32_t>& corners, std::size_t own_count,
                                        std::size_t vertex_count) {
  const auto end_of = [&](std::size_t c) { return corners[c % 3 == 2 ? c - 2 : c + 1]; };
  std::vector<std::uint32_t> start(vertex_count + 1, 0), edges(corners.size());
  for (std::size_t c = 0; c < corners.size(); ++c) ++start[std::min(corners[c], end_of(c)) + 1];
  for (std::size_t v = 0; v < vertex_count; ++v) start[v + 1] += start[v];
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (std::size_t c = 0; c < corners.size(); ++c) {
    edges[next[std::min(corners[c], end_of(c))]++] = static_cast<std::uint32_t>(c);
  }

  std::vector<std::uint32_t> border;
  for (std::size_t c = 0; c < 3 * own_count; ++c) {
    const std::uint32_t low = std::min(corners[c], end_of(c));
    const auto is_opposite = [&](std::uint32_t other) {
      return corners[other] == end_of(c) && end_of(other) == corners[c];
    };
    if (std::none_of(edges.begin() + start[low], edges.begin() + start[low + 1], is_opposite)) {
      border.insert(border.end(), {corners[c], end_of(c)});
    }
  }
  return border;
}

}  // namespace

TerrainChunk::TerrainChunk(const SurfaceView& surface, std::span<const std::uint32_t> own,
                           std::span<const std::uint32_t> fringe, float base)
    : own_count_(own.size()), base_(base) {
  index_vertices(surface, own, fringe);
  for (const std::uint32_t vertex : vertices_) materials_.push_back(surface.materials[vertex]);
  build_parts();
  border_ = border_edges(corners_, own_count_, vertices_.size());
  if (!border_.empty()) build_wall();
}

void TerrainChunk::index_vertices(const SurfaceView& surface, std::span<const std::uint32_t> own,
                                  std::span<const std::uint32_t> fringe) {
  for (const auto faces : {own, fringe}) {
    for (const std::uint32_t face : faces) {
      const auto corner = surface.triangles.begin() + 3 * static_cast<std::ptrdiff_t>(face);
      corners_.insert(corners_.end(), corner, corner + 3);
    }
  }
  vertices_ = corners_;
  std::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  for (std::uint32_t& corner : corners_) {
    const auto found = std::lower_bound(vertices_.begin(), vertices_.end(), corner);
    corner = static_cast<std::uint32_t>(found - vertices_.begin());
  }
}

// Sorts the own triangles by material. A corner alone in its material is cut off halfway along its edges; where all
// three differ they meet in the middle. Edges between equal corners stay whole, as the triangle beyond them may be.
std::map<std::uint8_t, std::vector<std::uint32_t>> TerrainChunk::split() {
  std::map<std::uint8_t, std::vector<std::uint32_t>> lists;
  std::map<Cut, std::uint32_t> made;
  const auto material = [&](std::uint32_t local) { return materials_[local]; };
  const auto add = [&](std::uint32_t of, std::initializer_list<std::uint32_t> corners) {
    auto& list = lists[material(of)];
    list.insert(list.end(), corners);
  };
  for (std::size_t t = 0; t < 3 * own_count_; t += 3) {
    const auto corner = [&](std::size_t k) { return corners_[t + k % 3]; };
    const auto differ = [&](std::size_t k) { return material(corner(k)) != material(corner(k + 1)); };
    const auto between = [&](std::uint32_t a, std::uint32_t b) { return cut_point(made, {{a, b, kNone}, 2}); };
    if (!differ(0) && !differ(1)) {
      add(corner(0), {corner(0), corner(1), corner(2)});
    } else if (differ(0) && differ(1) && differ(2)) {
      const std::uint32_t middle = cut_point(made, {{corner(0), corner(1), corner(2)}, 3});
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t after = between(corner(k), corner(k + 1)), before = between(corner(k), corner(k + 2));
        add(corner(k), {corner(k), after, middle, corner(k), middle, before});
      }
    } else {
      const std::size_t alone = differ(0) && differ(1) ? 1 : differ(1) ? 2 : 0;
      const std::uint32_t tip = corner(alone), next = corner(alone + 1), last = corner(alone + 2);
      const std::uint32_t after = between(tip, next), before = between(tip, last);
      add(tip, {tip, after, before});
      add(next, {after, next, last, after, last, before});
    }
  }
  return lists;
}

bool TerrainChunk::cut_again(const SurfaceView& surface) {
  bool changed = false;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const std::uint8_t now = surface.materials[vertices_[i]];
    changed |= std::exchange(materials_[i], now) != now;
  }
  if (!changed) return false;
  cuts_.clear();
  parts_.clear();
  awake_.clear();
  build_parts();
  return true;
}

void TerrainChunk::build_parts() {
  const auto lists = split();
  const auto count = static_cast<unsigned>(vertices_.size() + cuts_.size());
  positions_ = new osg::Vec3Array(count);
  normals_ = new osg::Vec3Array(count);
  sinkage_ = new osg::Vec2Array(count);
  marks_ = new osg::Vec4ubArray(count);
  index_count_ = 0;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    (*marks_)[i].set(0, static_cast<unsigned char>(materials_[i] % kScaleStops), 0, 0);
  }
  const auto geometry_of = [&](std::span<const std::uint32_t> corners) {
    osg::ref_ptr<osg::Geometry> geometry = make_geometry(*positions_, *normals_, *sinkage_);
    geometry->setVertexAttribArray(kMarkAttribute, marks_, osg::Array::BIND_PER_VERTEX);
    geometry->addPrimitiveSet(
        new osg::DrawElementsUInt(GL_TRIANGLES, static_cast<unsigned>(corners.size()), corners.data()));
    index_count_ += corners.size();
    return geometry;
  };
  for (const auto& [material, corners] : lists) parts_.push_back({material, geometry_of(corners)});
  mesh_ = parts_.size() == 1 ? parts_.front().ground : geometry_of(std::span(corners_).first(3 * own_count_));
}

// The local vertex of a cut, whichever way round its triangle names it.
std::uint32_t TerrainChunk::cut_point(std::map<Cut, std::uint32_t>& made, Cut cut) {
  std::sort(cut.of.begin(), cut.of.end());  // kNone stays last
  const auto next = static_cast<std::uint32_t>(vertices_.size() + cuts_.size());
  const auto [at, is_new] = made.emplace(cut, next);
  if (is_new) cuts_.push_back(cut);
  return at->second;
}

// Each border edge becomes a quad of its own: two corners on the ground, two at the base.
void TerrainChunk::build_wall() {
  const auto count = static_cast<unsigned>(2 * border_.size());
  wall_positions_ = new osg::Vec3Array(count);
  wall_normals_ = new osg::Vec3Array(count);
  wall_depth_ = new osg::Vec2Array(count);
  wall_ = make_geometry(*wall_positions_, *wall_normals_, *wall_depth_);
  osg::ref_ptr<osg::DrawElementsUInt> indices = new osg::DrawElementsUInt(GL_TRIANGLES);
  for (unsigned i = 0; i < count; i += 4) {
    for (const unsigned corner : {0u, 2u, 1u, 1u, 2u, 3u}) indices->push_back(i + corner);
  }
  wall_->addPrimitiveSet(indices);
}

bool TerrainChunk::touches(std::span<const DirtyRange> dirty) const {
  if (vertices_.empty()) return false;
  auto range = std::partition_point(dirty.begin(), dirty.end(),
                                    [&](const DirtyRange& r) { return r.second <= vertices_.front(); });
  for (; range != dirty.end() && range->first <= vertices_.back(); ++range) {
    const auto first = std::lower_bound(vertices_.begin(), vertices_.end(), range->first);
    if (first != vertices_.end() && *first < range->second) return true;
  }
  return false;
}

std::size_t TerrainChunk::refresh(const SurfaceView& surface, const Sinkage& sinkage) {
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Vec3& p = surface.positions[vertices_[i]];
    (*positions_)[i].set(p.x, p.y, p.z);
  }
  refresh_normals();
  refresh_sinkage(sinkage);
  refresh_cuts();
  for (osg::Array* array :
       {static_cast<osg::Array*>(positions_), static_cast<osg::Array*>(normals_), static_cast<osg::Array*>(sinkage_)}) {
    array->dirty();
  }
  for (const ChunkPart& part : parts_) part.ground->dirtyBound();
  mesh_->dirtyBound();
  if (wall_) refresh_wall();
  return kVertex * (positions_->size() + (wall_ ? wall_positions_->size() : 0));
}

std::size_t TerrainChunk::mark_awake(std::span<const std::uint32_t> awake) {
  if (vertices_.empty()) return 0;
  std::vector<std::uint32_t> now;
  const auto first = std::lower_bound(awake.begin(), awake.end(), vertices_.front());
  auto local = vertices_.begin();
  for (auto id = first; id != awake.end() && *id <= vertices_.back(); ++id) {
    local = std::lower_bound(local, vertices_.end(), *id);
    if (local != vertices_.end() && *local == *id) now.push_back(static_cast<std::uint32_t>(local - vertices_.begin()));
  }
  if (now == awake_) return 0;
  for (const std::uint32_t vertex : awake_) (*marks_)[vertex].x() = 0;
  for (const std::uint32_t vertex : now) (*marks_)[vertex].x() = 1;
  for (std::size_t i = 0; i < cuts_.size(); ++i) {
    const auto is_awake = [&](std::uint32_t vertex) { return (*marks_)[vertex].x() != 0; };
    const auto ends = std::span(cuts_[i].of).first(cuts_[i].count);
    (*marks_)[vertices_.size() + i].x() = std::any_of(ends.begin(), ends.end(), is_awake) ? 1 : 0;
  }
  awake_ = std::move(now);
  marks_->dirty();
  return marks_->getTotalDataSize();
}

std::size_t TerrainChunk::size_bytes() const {
  const std::size_t walls = wall_ ? wall_positions_->size() : 0;
  return kVertex * (positions_->size() + walls) + marks_->getTotalDataSize() +
         sizeof(std::uint32_t) * (index_count_ + walls / 4 * 6);
}

// The cross product is twice the triangle's area long, which is just the weight its normal should have.
void TerrainChunk::refresh_normals() {
  std::fill(normals_->begin(), normals_->end(), osg::Vec3());
  for (std::size_t c = 0; c < corners_.size(); c += 3) {
    const osg::Vec3 a = (*positions_)[corners_[c]], b = (*positions_)[corners_[c + 1]],
                    d = (*positions_)[corners_[c + 2]];
    const osg::Vec3 weighted = (b - a) ^ (d - a);
    for (std::size_t k = 0; k < 3; ++k) (*normals_)[corners_[c + k]] += weighted;
  }
  for (osg::Vec3& normal : *normals_) normal.normalize();
}

void TerrainChunk::refresh_sinkage(const Sinkage& sinkage) {
  largest_sinkage_ = 0;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const float sunk = sinkage ? sinkage(vertices_[i]) : 0.0f;
    (*sinkage_)[i].set(sunk, std::abs(sunk));
    largest_sinkage_ = std::max(largest_sinkage_, std::abs(sunk));
  }
  // Each corner takes the largest of its triangles; from the unspread values, so that it spreads by one ring only.
  for (std::size_t c = 0; c < corners_.size(); c += 3) {
    float largest = 0;
    for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, std::abs((*sinkage_)[corners_[c + k]].x()));
    for (std::size_t k = 0; k < 3; ++k) {
      float& spread = (*sinkage_)[corners_[c + k]].y();
      spread = std::max(spread, largest);
    }
  }
}

void TerrainChunk::refresh_cuts() {
  for (std::size_t i = 0; i < cuts_.size(); ++i) {
    const std::size_t at = vertices_.size() + i;
    const Cut& cut = cuts_[i];
    const float share = 1 / static_cast<float>(cut.count);
    osg::Vec3 position, normal;
    osg::Vec2 sunk;
    for (std::size_t k = 0; k < cut.count; ++k) {
      position += (*positions_)[cut.of[k]];
      normal += (*normals_)[cut.of[k]];
      sunk += (*sinkage_)[cut.of[k]];
    }
    normal.normalize();
    (*positions_)[at] = position * share;
    (*normals_)[at] = normal;
    (*sinkage_)[at] = sunk * share;
  }
}

void TerrainChunk::refresh_wall() {
  for (std::size_t edge = 0; edge < border_.size(); edge += 2) {
    const osg::Vec3 a = (*positions_)[border_[edge]], b = (*positions_)[border_[edge + 1]];
    osg::Vec3 outward = (b - a) ^ osg::Vec3(0, 0, 1);
    outward.normalize();
    const osg::Vec3 corners[] = {a, b, osg::Vec3(a.x(), a.y(), base_), osg::Vec3(b.x(), b.y(), base_)};
    for (std::size_t k = 0; k < 4; ++k) {
      (*wall_positions_)[2 * edge + k] = corners[k];
      (*wall_normals_)[2 * edge + k] = outward;
      (*wall_depth_)[2 * edge + k].set((k % 2 == 0 ? a : b).z() - corners[k].z(), 0.0f);
    }
  }
  wall_positions_->dirty();
  wall_normals_->dirty();
  wall_depth_->dirty();
  wall_->dirtyBound();
}

}  // namespace divot::viewer
