#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "divot/ids.h"
#include "divot/vec.h"
#include "geometry/bisection.h"
#include "geometry/bvh.h"
#include "geometry/grid_layout.h"
#include "geometry/half_edge_mesh.h"

namespace divot::state {

using geometry::GridLayout;

/// A terrain that came from a grid or a raster: what is needed to write one again.
struct Raster {
  GridLayout layout;
  double x0 = 0, y0 = 0;  ///< of column 0, row 0, in the terrain's coordinates, m
  double dx = 0, dy = 0;  ///< spacing, m, > 0
  std::string crs;        ///< WKT; empty when unknown
  std::string file_crs;   ///< WKT of a model in degrees; empty: the same
};

/// What of a mesh's surface does not face up, undersides and upright faces: nothing deforms it, bodies bump into it.
struct RigidFaces {
  std::vector<std::uint32_t> triangles;  ///< [3 * face] vertices
  /// [vertex from first_copy on] the vertex of the mesh at the same place: ground that touches itself in one only has
  /// one for each part.
  std::vector<std::uint32_t> copies;
  std::uint32_t first_copy = 0;
  geometry::Bvh bvh;  ///< over the faces as they were at the start

  bool any() const { return !triangles.empty(); }
};

/// The terrain. Written by terrain/ once, then by settle/ where particles moved and by refine/ where triangles come and
/// go.
struct Surface {
  Vec3d origin;                        ///< m: position + origin is in the terrain's coordinates
  geometry::HalfEdgeMesh mesh;         ///< vertices without a face are holes (nodata), or went with their triangles
  geometry::Bisection bisection;       ///< triangles that the terrain did not start with; not started: it keeps those
  RigidFaces rigid;                    ///< where the ground overhangs or stands upright; `mesh` has only what faces up
  std::vector<Vec3> position;          ///< [vertex] m, relative to origin
  std::vector<std::uint8_t> material;  ///< [vertex] index into the world's materials
  std::vector<std::uint32_t> column;   ///< [vertex] its soil column once it was touched, else kNone
  float spacing = 0;                   ///< m, mean of a grid's two spacings; where refined, of the finest triangles
  float strayed = 0;                   ///< m, no vertex went further sideways from where it started; kept while refined
  std::optional<Raster> raster;        ///< for terrain made from a grid
};

}  // namespace divot::state
