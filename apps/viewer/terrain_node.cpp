#include "viewer/terrain_node.h"

#include <algorithm>

namespace divot::viewer {
TerrainNode::TerrainNode() : ground_(new osg::Group), mesh_(new osg::Group), walls_(new osg::Group) {}

void TerrainNode::update(const SurfaceView& surface, std::span<const DirtyRange> dirty, const Topology& topology,
                         const Sinkage& sinkage) {
  if (chunks_.empty() || (topology.empty() && surface.triangles.size() != corner_count_))
    return rebuild(surface, sinkage);
  bool any_cut = !topology.empty();
  std::vector<bool> made(chunks_.size(), false);
  if (!topology.empty()) made = follow(surface, topology, sinkage);
  for (std::size_t cell = 0; cell < chunks_.size(); ++cell) {
    if (made[cell] || !chunks_[cell] || !chunks_[cell]->touches(dirty)) continue;
    TerrainChunk& chunk = *chunks_[cell];
    const bool cut = chunk.cut_again(surface);
    const std::size_t moved = chunk.refresh(surface, sinkage);
    uploaded_bytes_ += cut ? chunk.size_bytes() : moved;
    largest_sinkage_ = std::max(largest_sinkage_, chunk.largest_sinkage());
    any_cut |= cut;
  }
  if (any_cut) list_parts();
}

void TerrainNode::make_chunk(const SurfaceView& surface, std::size_t cell, const Sinkage& sinkage) {
  chunks_[cell].reset();
  if (cells_.own(cell).empty()) return;
  TerrainChunk& chunk = chunks_[cell].emplace(surface, cells_.own(cell), cells_.fringe(cell), base_);
  chunk.refresh(surface, sinkage);
  largest_sinkage_ = std::max(largest_sinkage_, chunk.largest_sinkage());
  uploaded_bytes_ += chunk.size_bytes();
}

// Makes those chunks anew that have other triangles than before and says which. [O(faces), chunks made apart]
std::vector<bool> TerrainNode::follow(const SurfaceView& surface, const Topology& topology, const Sinkage& sinkage) {
  corner_count_ = surface.triangles.size();
  std::vector<bool> changed = cells_.follow(surface, topology);
  chunks_.resize(changed.size());
  for (std::size_t cell = 0; cell < chunks_.size(); ++cell)
    if (changed[cell]) make_chunk(surface, cell, sinkage);
  return changed;
}

// Hangs what the chunks draw below the groups that are drawn. [O(chunks)]
void TerrainNode::list_parts() {
  ground_->removeChildren(0, ground_->getNumChildren());
  ground_materials_.clear();
  mesh_->removeChildren(0, mesh_->getNumChildren());
  walls_->removeChildren(0, walls_->getNumChildren());
  for (std::optional<TerrainChunk>& chunk : chunks_) {
    if (!chunk) continue;
    for (const ChunkPart& part : chunk->parts()) {
      if (part.material < looks_.size()) part.ground->setStateSet(looks_[part.material]);
      ground_->addChild(part.ground);
      ground_materials_.push_back(part.material);
    }
    mesh_->addChild(&chunk->mesh());
    if (chunk->wall()) walls_->addChild(chunk->wall());
  }
}

void TerrainNode::mark_awake(std::span<const std::uint32_t> awake) {
  for (std::optional<TerrainChunk>& chunk : chunks_)
    if (chunk) uploaded_bytes_ += chunk->mark_awake(awake);
}

std::uint64_t TerrainNode::size_bytes() const {
  std::uint64_t sum = 0;
  for (const std::optional<TerrainChunk>& chunk : chunks_)
    if (chunk) sum += chunk->size_bytes();
  return sum;
}

void TerrainNode::rebuild(const SurfaceView& surface, const Sinkage& sinkage) {
  measure(surface, sinkage);
  largest_sinkage_ = 0;
  chunks_.clear();
  corner_count_ = surface.triangles.size();
  cells_.build(surface, bounds_);
  chunks_.resize(cells_.size());

  Region original = bounds_;
  original.min.z = lowest_ + surface.origin.z;
  base_ = static_cast<float>(block_base(original) - surface.origin.z);
  for (std::size_t cell = 0; cell < chunks_.size(); ++cell) make_chunk(surface, cell, sinkage);
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
