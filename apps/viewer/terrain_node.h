#pragma once

#include <optional>
#include <osg/Group>
#include <vector>

#include "divot/views.h"
#include "viewer/camera.h"
#include "viewer/terrain_cells.h"
#include "viewer/terrain_chunk.h"

namespace divot::viewer {

/// The ground as chunks that are culled and sent to the graphics card one by one.
class TerrainNode {
 public:
  TerrainNode();

  /// Takes over the ground. Chunks are made when it is seen first, and again where `topology` says that triangles are
  /// other ones; with an empty one all of them, whenever their number has changed. Otherwise only those that `dirty`
  /// (ascending, disjoint) touches are sent again, and cut again where materials in them have changed. [O(faces) the
  /// first time and with other triangles, then O(chunks + dirty chunks)]
  void update(const SurfaceView& surface, std::span<const DirtyRange> dirty, const Topology& topology,
              const Sinkage& sinkage);

  /// Takes over all of it in the next update(): that of another world, which only tells what moved in it.
  void forget() { chunks_.clear(); }

  /// Marks which vertices are awake particles; ids, ascending. [O(chunks + awake)]
  void mark_awake(std::span<const std::uint32_t> awake);

  /// State under which each material is drawn, [material]; where one is missing or null, nothing is set. Takes effect
  /// when chunks are made.
  void set_looks(std::vector<osg::ref_ptr<osg::StateSet>> looks) { looks_ = std::move(looks); }

  /// One geometry for each chunk and material.
  osg::Group& ground() { return *ground_; }
  /// The material of each child of ground().
  std::span<const std::uint8_t> ground_materials() const { return ground_materials_; }
  /// The ground's triangles, for lines.
  osg::Group& mesh() { return *mesh_; }
  osg::Group& walls() { return *walls_; }

  /// Heights of the ground before anything deformed it, m, relative to the origin: they colour the picture and must not
  /// change with it.
  float lowest() const { return lowest_; }
  float highest() const { return highest_; }
  /// Largest |sinkage| so far, m.
  float largest_sinkage() const { return largest_sinkage_; }

  /// Bytes of vertices and indices that were handed over to be sent to the graphics card, since the node was made.
  std::uint64_t uploaded_bytes() const { return uploaded_bytes_; }
  /// Bytes that sending everything takes. [O(chunks)]
  std::uint64_t size_bytes() const;

  /// Bounds when the chunks were made, in the terrain's coordinates.
  const Region& bounds() const { return bounds_; }

 private:
  void rebuild(const SurfaceView& surface, const Sinkage& sinkage);
  std::vector<bool> follow(const SurfaceView& surface, const Topology& topology, const Sinkage& sinkage);
  void make_chunk(const SurfaceView& surface, std::size_t cell, const Sinkage& sinkage);
  void list_parts();
  void measure(const SurfaceView& surface, const Sinkage& sinkage);

  osg::ref_ptr<osg::Group> ground_, mesh_, walls_;
  std::vector<osg::ref_ptr<osg::StateSet>> looks_;
  std::vector<std::uint8_t> ground_materials_;
  TerrainCells cells_;
  std::vector<std::optional<TerrainChunk>> chunks_;  // [cell] none where it has no triangles
  std::size_t corner_count_ = 0;
  float base_ = 0;  // m, height of the walls' foot, relative to the origin
  Region bounds_;
  float lowest_ = 0, highest_ = 0, largest_sinkage_ = 0;
  std::uint64_t uploaded_bytes_ = 0;
};

}  // namespace divot::viewer
