#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "divot/errors.h"
#include "divot/ids.h"
#include "divot/jobs.h"
#include "divot/raster.h"
#include "divot/recording.h"
#include "divot/scene.h"
#include "divot/views.h"

namespace divot {

/// What one step met that a caller should know of. Nothing here is an error; the world stays usable.
struct StepReport {
  int substeps = 1;                 ///< how often forces and motion were evaluated within the step
  bool substeps_limited = false;    ///< more would have been needed for full stiffness; the ground was softened instead
  bool refinement_limited = false;  ///< the budget of new triangles is used up; where they are missing ground is coarse
  bool not_finite = false;  ///< a value left the range of numbers; the particle or body was put to rest where it was
};

/// Time and calls of a stage since the world was made.
struct StageTime {
  const char* name;         ///< as in docs/architecture.md
  double ms = 0;            ///< milliseconds in all
  std::uint64_t calls = 0;  ///< how often it ran
};

/// How often search structures were brought up to date since the world was made.
struct UpdateCounts {
  std::uint64_t neighbour_rebuilds = 0;  ///< rows built anew
  std::uint64_t bvh_refits = 0;          ///< boxes made to fit again
  std::uint64_t bvh_rebuilds = 0;        ///< trees built anew
  /// Pairs in range that rows did not hold when they were built anew. 0 for every_step; with adaptive only pairs that
  /// came nearer by more than the skin within the last substep, which were found in time.
  std::uint64_t missed_pairs = 0;
};

/// New triangles ([terrain.refine]) since the world was made.
struct RefinementCounts {
  bool on = false;  ///< false: the terrain keeps the triangles it starts with
  double edge = 0;  ///< m, of the finest triangles: what bodies and bombs of the scene want, within limits
  std::uint64_t base_vertices = 0;  ///< that the terrain started with
  std::uint64_t vertices = 0;       ///< there now, beyond those that the terrain started with
  std::uint64_t most = 0;           ///< most so far, at the end of a step
  std::uint64_t budget = 0;         ///< more there may not be
  std::uint64_t halved = 0;         ///< vertices that came so far
  std::uint64_t joined = 0;         ///< vertices that went so far
  std::uint64_t short_steps = 0;    ///< steps in which the budget left triangles coarser than they should be
};

/// A crater as the surface shows it.
struct Crater {
  Vec3d position;          ///< ground zero as it was: the point of the ground next to the bomb, m
  double yield = 0;        ///< t of TNT
  double width = 0;        ///< m, apparent, at original ground level, edge at 5 % of the depth
  double depth = 0;        ///< m, below original ground
  double lip_height = 0;   ///< m, above original ground
  double volume = 0;       ///< m^3 below original ground, inside its edge
  double lip_volume = 0;   ///< m^3 above original ground, from its edge to 2.5 radii
  double paper_width = 0;  ///< m, eq. 10
};

/// Where the soil went since the world was made, m^3. Displaced and deposited are integrated over the surface,
/// compacted is summed over the soil's change of density.
struct SoilVolume {
  double displaced = 0;  ///< below where the ground was
  double compacted = 0;  ///< of it, lost to density
  double deposited = 0;  ///< above where the ground was
  /// |displaced - compacted - deposited| / displaced; 0 when nothing moved.
  double relative_error() const;
};

/// Mechanical energy, J. What is missing against the start went into soil: yield, friction, damping; what came in, from
/// bombs.
struct Energy {
  double bodies_kinetic = 0;    ///< of their motion and spin
  double bodies_potential = 0;  ///< in Scene::gravity, against the origin of the terrain's coordinates
  double ground_kinetic = 0;    ///< of the particles that are awake
};

/// Ground, bodies and bombs that move together. Steps on the threads it was given; several worlds live side by side.
class World {
 public:
  /// Loads the terrain and places what the scene holds. Fails with everything that is wrong with the scene or its
  /// files.
  static Result<World> create(const Scene& scene, std::shared_ptr<const Jobs> jobs = nullptr);

  /// Everything that decides how the world goes on, as bytes. Their size follows what was ever touched and what is
  /// awake, never the size of the terrain. [O(touched vertices)]
  std::string save() const;

  /// A world as it was when save() gave `bytes`: from here on both go through the same bits. `scene`: the one that it
  /// was created from; its `duration` and `output` may differ. Fails where the scene or its files are others and where
  /// the bytes are damaged, which takes no more memory than a world whose state they could be. With
  /// UpdatePolicy::Kind::every, whose boxes miss what moved since the last rebuild, they miss less after it.
  static Result<World> restore(std::string_view bytes, const Scene& scene, std::shared_ptr<const Jobs> jobs = nullptr);

  World(World&&) noexcept;             ///< views stay valid
  World& operator=(World&&) noexcept;  ///< likewise
  ~World();

  /// Advances by Scene::dt. Cost follows the particles that are awake, never the size of the terrain.
  StepReport step();

  /// Adds a body now. Fails like a scene with that body.
  Result<BodyId> spawn(const BodySettings& body);

  /// Joins two bodies as they stand now, or one with the terrain. Fails like a scene with that joint.
  Result<JointId> add_joint(const Joint& joint);

  /// From now on the joint's motor strives for `speed` with at most `force`, as Joint::motor_speed and motor_force have
  /// them, in place of its profiles. A fixed joint has no motor.
  void set_motor(JointId joint, double speed, double force);

  /// Steers a wheel to `angle_deg` from now on, in place of its profile.
  void set_steering(JointId joint, double angle_deg);

  /// Adds a bomb; one whose time has passed goes off in the next step. Fails like a scene with that bomb.
  Result<void> add_bomb(const Bomb& bomb);

  /// Pushes the ground at the start of the next step, on top of what it does already; what a body carries stays with
  /// the body. Fails when a number is not finite or the radius is not above 0. [O(log faces + pushed)]
  Result<void> push_ground(const GroundPush& push);

  /// Does what was done to another world at the same step. Fails like the call it stands for.
  Result<void> carry_out(const Command& command);

  /// From now on what the calls above do is kept in commands(), where they succeed: a recording of the session.
  void keep_commands();
  std::span<const Command> commands() const;  ///< in order

  /// A number that tells scenes apart: over every key but `duration` and those of `output`.
  std::uint64_t scene_fingerprint() const;

  double time() const;          ///< s
  std::uint64_t steps() const;  ///< taken since the start
  const Scene& scene() const;   ///< as given to create()

  SurfaceView surface() const;                  ///< the ground
  ParticleView particles() const;               ///< what is awake
  std::vector<BodyView> bodies() const;         ///< by BodyId
  std::vector<JointView> joints() const;        ///< by JointId
  std::vector<BombView> bombs() const;          ///< by time
  std::span<const Material> materials() const;  ///< by index, as SurfaceView::materials refers to them

  /// Vertices that moved since the last call, as ascending disjoint ranges. For uploads: send just these.
  std::vector<DirtyRange> take_dirty();

  /// Triangles that are other ones since the last call and vertices that came or went, where the scene asks for
  /// refinement. What came is among the dirty ranges too; its id may be that of one that went before.
  Topology take_topology();

  /// How far the vertex lies below the ground it started as, m; negative where soil was deposited.
  float sinkage(std::uint32_t vertex) const;

  /// Pressure by which the soil holds up the vertex, Pa: of its elastic branch or Bekker's curve (docs/physics.md,
  /// "Ground"); 0 where it is asleep.
  float pressure(std::uint32_t vertex) const;

  /// Height of the ground at x, y in the terrain's coordinates, m; NaN outside it.
  double ground_height(double x, double y) const;

  /// Heights on the grid the terrain came from, for rasters; nothing for terrain that came from a mesh. With `spacing`
  /// > 0, m, pixels are at most so far apart, the grid's nodes among them: for ground that is refined. [O(pixels)]
  std::optional<RasterView> raster(double spacing = 0) const;

  /// Boxes, least and greatest corner relative to the surface's origin, of one level of the bounding volume hierarchy
  /// over the surface, the root's being 0: none below the deepest. For looking at. [O(triangles)]
  std::vector<std::pair<Vec3, Vec3>> bvh_boxes(int level) const;

  std::size_t peak_particles() const;     ///< most particles awake at once so far
  std::vector<StageTime> stages() const;  ///< in running order
  UpdateCounts updates() const;           ///< of search structures
  RefinementCounts refinement() const;    ///< new triangles
  std::vector<Crater> craters() const;    ///< one for each bomb that went off, in order
  SoilVolume soil_volume() const;         ///< [O(touched vertices)]
  Energy energy() const;                  ///< [O(awake particles + bodies)]

  /// 64 bits over every surface position, awake particle and body. Equal runs give equal bits.
  std::uint64_t state_hash() const;

  struct Impl;  ///< everything a world owns; of no use outside the library

 private:
  explicit World(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace divot
