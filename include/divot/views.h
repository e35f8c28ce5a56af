#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "divot/shape.h"
#include "divot/vec.h"

namespace divot {

/// The ground as it stands, without a copy. Valid until the world's next step.
struct SurfaceView {
  Vec3d origin;                     ///< m; add to a position for the terrain's own coordinates
  std::span<const Vec3> positions;  ///< [vertex] m, relative to origin
  std::span<const std::uint32_t>
      triangles;  ///< [3 * face] vertex ids, counter-clockwise from above: ready as an index buffer
  std::span<const std::uint8_t> materials;  ///< [vertex] index into World::materials()
  double spacing = 0;                       ///< m, mean grid spacing; where refined, of the finest triangles
  std::size_t rigid = 0;  ///< triangles, the first, that do not face up: bodies bump into them, nothing deforms them
};

/// What may move a particle.
enum class Hold : std::uint8_t {
  free,     ///< forces
  carried,  ///< the body that presses on it
  anchor,   ///< nothing: it stands at the border of the awake ground
  asleep,   ///< nothing: it has been still and leaves in the next step
};

/// The particles that are awake, without a copy. Valid until the world's next step.
struct ParticleView {
  std::span<const std::uint32_t> vertices;  ///< [particle] the surface vertex it moves, ascending
  std::span<const float> x;                 ///< [particle] m, relative to the surface's origin
  std::span<const float> y;                 ///< [particle] likewise
  std::span<const float> z;                 ///< [particle] likewise
  std::span<const float> vx;                ///< [particle] m/s
  std::span<const float> vy;                ///< [particle] m/s
  std::span<const float> vz;                ///< [particle] m/s
  std::span<const float> mass;              ///< [particle] kg
  std::span<const Hold> hold;               ///< [particle] what moves it, a Hold
};

/// A body as it is now.
struct BodyView {
  std::string name;                    ///< as in the scene
  double radius = 0;                   ///< m, of the ball round its centre of mass that holds it
  double mass = 0;                     ///< kg
  Vec3d position;                      ///< of the shape's origin, m, in the terrain's coordinates
  Quat orientation;                    ///< of the shape's axes
  Vec3d velocity;                      ///< of the centre of mass, m/s
  Vec3d angular_velocity;              ///< rad/s
  double sinkage = 0;                  ///< m, how deep its lowest contact lies below the original ground; 0 in the air
  double max_sinkage = 0;              ///< m, the largest so far
  bool touching = false;               ///< pressed ground at the end of the last step
  bool off_terrain = false;            ///< has left the terrain and falls
  std::shared_ptr<const Shape> shape;  ///< never null; hulls have their corners and triangles
};

/// A joint as it is now.
struct JointView {
  std::string name;        ///< as in the scene
  double position = 0;     ///< m of travel; hinge: degrees of turn; wheel: m of suspension travel
  double speed = 0;        ///< m/s; hinge, wheel: rad/s of turn or spin
  double motor_force = 0;  ///< N or N m, what the motor gave in the last step
};

/// A bomb as it is now.
struct BombView {
  Vec3d position;         ///< m, in the terrain's coordinates
  double time = 0;        ///< s
  double yield = 0;       ///< t of TNT
  bool exploded = false;  ///< has gone off
};

/// Vertices [first, last) whose position changed.
using DirtyRange = std::pair<std::uint32_t, std::uint32_t>;

/// What became of the triangles.
struct Topology {
  /// Triangles [first, last) that have other corners, ascending and disjoint; those from SurfaceView::triangles.size()
  /// / 3 on are gone.
  std::vector<DirtyRange> triangles;
  std::vector<std::uint32_t> added;                 ///< vertices that came, ascending
  std::vector<std::uint32_t> removed;               ///< vertices that went, ascending: no triangle has them any more
  bool empty() const { return triangles.empty(); }  ///< true: as before
};

}  // namespace divot
