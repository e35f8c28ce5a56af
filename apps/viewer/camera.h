#pragma once

#include <span>

#include "divot/views.h"

namespace divot::viewer {

/// Where a picture is taken from. Up is z.
struct Camera {
  Vec3d eye;            ///< m, in the terrain's coordinates
  Vec3d target;         ///< m, the point in the middle of the picture; must differ from eye in x or y
  double fov_deg = 32;  ///< vertical field of view, degrees, (0, 120]
  friend bool operator==(const Camera&, const Camera&) = default;
};

/// A box in the terrain's coordinates, m.
struct Region {
  Vec3d min, max;
  Vec3d center() const { return (min + max) * 0.5; }
  double extent() const;  ///< m, the larger of its sides along x and y
};

/// Bounds of the ground's triangles; a point at the origin when there are none. [O(faces)]
Region terrain_bounds(const SurfaceView& surface);

/// Height of the bottom of the block that the terrain is drawn as, m, in the terrain's coordinates.
double block_base(const Region& terrain);

/// Where to look from, and at what.
struct Framing {
  Camera camera;
  Region region;  ///< what the picture is about; shadows, detail and the size of bombs follow it
};

/// A three-quarter view from above on bombs with the ground they will move, and on bodies; or on all of the terrain
/// when these take up half of it anyway, a seventh of it where there are no bombs, or when there are none. `aspect`:
/// width over height of the picture. [O(faces + bodies + bombs)]
Framing frame(const SurfaceView& surface, std::span<const BodyView> bodies, std::span<const BombView> bombs,
              double aspect = 16.0 / 9.0);

}  // namespace divot::viewer
