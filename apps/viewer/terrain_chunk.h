#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <osg/Geometry>
#include <span>
#include <vector>

#include "divot/views.h"

namespace divot::viewer {

/// Sinkage of a vertex, m; see World::sinkage.
using Sinkage = std::function<float(std::uint32_t vertex)>;

/// Vertex attribute that carries two numbers: the vertex's sinkage, and the largest |sinkage| of it and its neighbours.
/// The second tells turned soil from untouched, also on the line where a crater's bowl turns into its lip and the
/// sinkage itself is 0.
inline constexpr unsigned kSinkageAttribute = 6;

/// Vertex attribute of two small numbers: 1 where the vertex is an awake particle, and the colour of its material.
inline constexpr unsigned kMarkAttribute = 7;

/// The ground of one material within a chunk.
struct ChunkPart {
  std::uint8_t material;
  osg::ref_ptr<osg::Geometry> ground;
};

/// A part of the terrain small enough to be sent again as a whole when one of its vertices moved.
///
/// It keeps copies of its vertices and also knows the triangles of its neighbours that touch them (the fringe), so that
/// its normals are the same as those across the border. Where the terrain ends, a wall goes down to the block's base.
///
/// Triangles whose corners are of different materials are cut halfway along their edges, so that borders are sharp. The
/// points of the cuts are vertices of the chunk alone, between two or three of the surface's.
class TerrainChunk {
 public:
  /// Own triangles and fringe, as indices into `surface.triangles` / 3. `base`: height of the wall's foot, m, relative
  /// to the origin.
  TerrainChunk(const SurfaceView& surface, std::span<const std::uint32_t> own, std::span<const std::uint32_t> fringe,
               float base);

  /// True when a vertex that it draws or takes normals from lies in one of the ascending, disjoint `dirty` ranges.
  /// [O(ranges within its ids * log vertices)]
  bool touches(std::span<const DirtyRange> dirty) const;

  /// Cuts the triangles again where vertices have become another material, as a road does that breaks: parts() and
  /// mesh() are others then, without marks, and want a refresh(). Returns false when no vertex has. [O(vertices)]
  bool cut_again(const SurfaceView& surface);

  /// Copies positions and sinkage, recomputes normals and marks them for upload. Returns how many bytes will be sent.
  /// [O(vertices + triangles)]
  std::size_t refresh(const SurfaceView& surface, const Sinkage& sinkage);

  /// Marks which vertices are awake; `awake`: ids, ascending. Returns how many bytes will be sent: none when the same
  /// vertices are awake as before. [O(vertices awake here + log awake)]
  std::size_t mark_awake(std::span<const std::uint32_t> awake);

  /// Largest |sinkage| of its vertices at the last refresh(), m.
  float largest_sinkage() const { return largest_sinkage_; }

  /// Bytes of all its vertices and indices.
  std::size_t size_bytes() const;

  /// Ascending by material; all share one set of arrays.
  const std::vector<ChunkPart>& parts() const { return parts_; }
  /// The triangles as they are, whatever they are made of.
  osg::Geometry& mesh() { return *mesh_; }
  /// Null where the terrain does not end within the chunk.
  osg::Geometry* wall() { return wall_.get(); }

 private:
  // A point between `count` local vertices.
  struct Cut {
    std::array<std::uint32_t, 3> of;
    std::uint32_t count;
    friend auto operator<=>(const Cut&, const Cut&) = default;
  };

  void index_vertices(const SurfaceView& surface, std::span<const std::uint32_t> own,
                      std::span<const std::uint32_t> fringe);
  std::map<std::uint8_t, std::vector<std::uint32_t>> split();
  void build_parts();
  std::uint32_t cut_point(std::map<Cut, std::uint32_t>& made, Cut cut);
  void refresh_cuts();
  void build_wall();
  void refresh_normals();
  void refresh_sinkage(const Sinkage& sinkage);
  void refresh_wall();

  std::vector<std::uint32_t> vertices_;  // [local vertex] id, ascending
  std::vector<std::uint8_t> materials_;  // [local vertex of the surface] as the triangles are cut by
  std::vector<std::uint32_t> corners_;   // [3 * triangle + corner] local vertex; own triangles first
  std::size_t own_count_;                // triangles that are drawn
  std::size_t index_count_ = 0;          // of all geometries of the ground
  std::vector<Cut> cuts_;                // local vertices after those of the surface
  std::vector<std::uint32_t> awake_;     // local vertices that are marked so, ascending
  float largest_sinkage_ = 0;            // m
  std::vector<std::uint32_t> border_;    // [2 * edge + end] local vertices of edges with ground on one side only
  float base_;                           // m
  std::vector<ChunkPart> parts_;
  osg::ref_ptr<osg::Geometry> mesh_, wall_;
  osg::ref_ptr<osg::Vec3Array> positions_, normals_, wall_positions_, wall_normals_;
  osg::ref_ptr<osg::Vec2Array> sinkage_, wall_depth_;
  osg::ref_ptr<osg::Vec4ubArray> marks_;  // four bytes, as cards like them aligned
};

}  // namespace divot::viewer
