#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "divot/vec.h"

namespace divot {

// What bodies look like. Each shape has axes and an origin of its own; a body's position is where its origin is.

/// A ball; the origin is its centre.
struct Sphere {
  double radius = 1;  ///< m, > 0
};

/// A cuboid; the origin is its centre.
struct Box {
  Vec3d size = {1, 1, 1};  ///< whole lengths along x, y, z, m, > 0
};

/// A cylinder that lies as a wheel does: its axis is y; the origin is its centre.
struct Cylinder {
  double radius = 1;  ///< m, > 0
  double length = 1;  ///< along y, m, > 0
};

/// A cylinder that ends in two half balls: its axis is y; the origin is its centre.
struct Capsule {
  double radius = 1;  ///< m, > 0
  double length = 1;  ///< between the centres of the two balls, along y, m, > 0
};

/// A cone that stands on its base: its axis is z, the tip up; the origin lies half-way up.
struct Cone {
  double radius = 1;  ///< of the base, m, > 0
  double height = 1;  ///< m, > 0
};

/// The convex hull of a mesh or of points; the origin is theirs.
struct Hull {
  std::string file =
      {};            ///< OBJ, PLY, STL or glTF; relative paths start at the scene's folder; empty: `points` are given
  double scale = 1;  ///< of what is read or given, > 0
  std::vector<Vec3d> points = {};  ///< m, at least 4 that span a volume; a BodyView has the corners of the hull here
  std::vector<std::uint32_t> triangles = {};  ///< [3 * face] indices into `points`, outward; only a BodyView has them
};

/// A convex shape.
using ConvexShape = std::variant<Sphere, Box, Cylinder, Capsule, Cone, Hull>;

/// One convex piece of a compound.
struct Part {
  ConvexShape shape = Sphere{};  ///< what it looks like
  Vec3d position = {};           ///< of the part's origin in the body's axes, m
  Vec3d rotation_deg = {};       ///< about x, then y, then z of the body, degrees
};

/// Convex parts that are one rigid body; the origin is that of the parts' positions. Where parts overlap, mass counts
/// twice.
struct Compound {
  std::vector<Part> parts = {};  ///< at least one
};

/// Any shape a body can have.
using Shape = std::variant<Sphere, Box, Cylinder, Capsule, Cone, Hull, Compound>;

/// The rotation by angles about the fixed axes x, then y, then z, degrees.
Quat rotation(const Vec3d& rotation_deg);

}  // namespace divot
