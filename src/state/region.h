#pragma once

#include <cstdint>
#include <vector>

#include "geometry/bvh.h"
#include "math/aabb.h"
#include "state/surface.h"

namespace divot::state {

/// Scratch of the queries below: grows once and stays.
struct RegionScratch {
  std::vector<std::uint32_t> faces;
};

/// Faces whose box meets `box`, ascending: all that truly do and some nearby. `bvh` is over the faces that the terrain
/// started with.
void faces_near(const Surface& surface, const geometry::Bvh& bvh, const math::Aabb& box,
                std::vector<std::uint32_t>& faces);

/// Vertices of faces whose box in `bvh` meets `box`, ascending, each once: every vertex in the box and some beside it.
void vertices_near(const Surface& surface, const geometry::Bvh& bvh, const math::Aabb& box, RegionScratch& scratch,
                   std::vector<std::uint32_t>& vertices);

/// A point of the surface.
struct SurfacePoint {
  bool found = false;
  Vec3 position;                 ///< m, relative to the origin
  std::uint32_t vertex = kNone;  ///< the nearest corner of its face
  std::uint32_t face = kNone;
};

/// The highest point of the surface over x, y, relative to the origin; not found outside the surface and over holes.
SurfacePoint surface_at(const Surface& surface, const geometry::Bvh& bvh, float x, float y, RegionScratch& scratch);

/// The ground that a place belongs to: what it lies in where nothing rigid is between, else the highest below it, as
/// under a bridge. Where nothing overhangs, the same as above.
SurfacePoint surface_at(const Surface& surface, const geometry::Bvh& bvh, const Vec3& place, RegionScratch& scratch);

/// Does a rigid face cross the upright line over x, y between two heights, m?
bool rigid_between(const Surface& surface, float x, float y, float z0, float z1, RegionScratch& scratch);

/// Moves a vertex of the surface to `to` and returns the volume that has vanished below it, m^3: what the faces round
/// it sweep, which is exact for any motion while the others stand still. A vertex of the border must keep its x and y.
/// [O(valence)]
double move_vertex(Surface& surface, std::uint32_t vertex, const Vec3& to);

/// Unit normal of a vertex, upward, weighted by the area of its faces. [O(valence)]
Vec3 vertex_normal(const Surface& surface, std::uint32_t vertex);

}  // namespace divot::state
