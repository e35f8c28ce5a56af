#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "divot/shape.h"
#include "geometry/convex_hull.h"
#include "math/quat.h"

namespace divot::geometry {

/// A convex piece of a solid, in the solid's axes.
struct Piece {
  enum class Kind : std::uint8_t { sphere, box, cylinder, capsule, cone, hull };
  Kind kind = Kind::sphere;
  double radius = 1;       // m; sphere, cylinder, capsule, cone
  double half_length = 0;  // m along y, for a cone along z
  Vec3d half;              // m, of a box
  std::shared_ptr<const ConvexHull> hull;
  Vec3d position;  // m
  Quat rotation;
};

/// A shape around its centre of mass, with its principal axes of inertia as axes: what contact and Bullet work with.
struct Solid {
  std::vector<Piece> pieces;
  double radius = 1;  ///< m, of the ball round the centre of mass that holds it
  Vec3d origin;       ///< of the shape's own axes in the solid's, m
  Quat axes;          ///< likewise
  Vec3d inertia;      ///< about the solid's axes, of a kilogram, m^2
};

/// How the shape fills space.
struct MassProperties {
  double volume = 0;      ///< m^3
  Vec3d center;           ///< m, in the shape's axes
  math::Matrix3 inertia;  ///< about the centre, of a kilogram, m^2
};
/// Of a shape whose hulls have their points; nothing where one spans no volume.
std::optional<MassProperties> mass_properties(const Shape& shape);

/// `center` and `inertia` (of a kilogram, about the shape's axes) replace the shape's own where given. Nothing where a
/// hull spans no volume.
std::optional<Solid> make_solid(const Shape& shape, const std::optional<Vec3d>& center = {},
                                const std::optional<Vec3d>& inertia = {});

/// The shape with each hull reduced to its corners and triangulated: what is drawn.
Shape drawn(const Shape& shape);

}  // namespace divot::geometry
