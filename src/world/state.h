#pragma once

#include <memory>
#include <vector>

#include "activation/activation.h"
#include "contact/contact.h"
#include "core/id_set.h"
#include "core/timers.h"
#include "divot/world.h"
#include "events/events.h"
#include "forces/evaluate.h"
#include "integration/integrators.h"
#include "laws/medium.h"
#include "neighbours/neighbours.h"
#include "refine/refine.h"
#include "refit/refit.h"
#include "settle/settle.h"
#include "state/blasts.h"
#include "state/bodies.h"
#include "state/joints.h"
#include "state/particles.h"
#include "state/soil.h"
#include "state/surface.h"

namespace divot {

/// Rows of the timers, in running order.
enum class Stage { refine, events, contact, activation, neighbours, forces, integration, settle, refit, count };
inline constexpr const char* kStageNames[] = {"refine", "events",      "contact", "activation", "neighbours",
                                              "forces", "integration", "settle",  "refit"};

/// A bomb and whether it has gone off.
struct PlannedBomb {
  Bomb bomb;  ///< with its position resolved against the ground
  bool exploded = false;
};

/// Everything a world owns. Only world/ sees it whole.
struct World::Impl {
  Scene scene;
  std::shared_ptr<const Jobs> jobs;
  std::vector<Material> materials;
  std::vector<laws::Medium> media;

  state::Surface surface;
  state::Soil soil;
  state::Particles particles;
  state::Bonds bonds;
  std::vector<state::Body> bodies;
  std::vector<state::HeldJoint> joints;
  std::vector<PlannedBomb> bombs;
  std::vector<state::Blast> blasts;
  std::vector<Command> commands;
  bool keeps_commands = false;
  void keep(decltype(Command::what) what) {
    if (keeps_commands) commands.push_back({step_count, std::move(what)});
  }

  double lowest = 0;                      ///< m, of the terrain as it was loaded
  std::uint64_t terrain_fingerprint = 0;  ///< of places, triangles and materials, as they were loaded

  refit::Tree tree;
  neighbours::Index neighbours;
  contact::RigidBodies rigid;
  settle::Moved moved;
  settle::Scratch settle_scratch;
  std::vector<std::uint32_t> wake;
  std::vector<events::Kick> kicks;
  std::vector<std::uint32_t> broken;  ///< scratch: vertices whose crust breaks in this step
  std::vector<bool> dirty_chunk;      ///< [vertex / kDirtyChunk]

  refine::Limits refine_limits;  ///< derived from the scene
  refine::Progress refine_progress;
  std::function<std::uint8_t(double x, double y)> material_at;  ///< between vertices; follows from the scene
  refine::Scratch refine_scratch;
  core::IdSet retriangulated;            ///< vertices that came or went since take_topology()
  std::vector<std::uint32_t> triangles;  ///< of rigid faces, then of the ground, for views; empty without the former
  std::vector<bool> shown;               ///< [added vertex] was there at the last take_topology()

  activation::Scratch activation_scratch;
  contact::Scratch contact_scratch;
  forces::Scratch forces_scratch;
  integration::Scratch integration_scratch;
  mutable state::RegionScratch region_scratch;

  std::uint64_t step_count = 0;
  std::size_t peak_particles = 0;
  std::vector<float> least_mass;  ///< [material] kg, of the particles that are awake
  core::Timers<static_cast<std::size_t>(Stage::count)> timers;

  double time() const { return static_cast<double>(step_count) * scene.dt; }
  /// Does it go off in this step? A bomb belongs to the step whose start is nearest.
  bool is_due(const PlannedBomb& planned) const {
    return !planned.exploded && planned.bomb.time <= time() + 0.5 * scene.dt;
  }
  template <class Work>
  auto timed(Stage stage, Work&& work) {
    return timers.time(static_cast<std::size_t>(stage), work);
  }

  void plan_refinement();                         ///< how fine the scene's bodies and bombs want the ground
  void plan_refinement(state::Body& body) const;  ///< how fine one wants it that comes later
  void reserve_budget();  ///< views of the ground stay where they are, however many triangles come
  void list_triangles();  ///< after faces came or went
  void mark_dirty(std::uint32_t vertex);

  // The stages, with their inputs and outputs taken from the state (stages.cpp).
  bool refine_ground(StepReport& report);  ///< true where rows of particles have changed
  void set_off_bombs();
  void move_bodies(StepReport& report);
  bool wake_and_sleep();
  bool break_crusts();  ///< true where particles are of another material now
  void find_neighbours(bool particles_changed);
  void move_particles(bool particles_changed, StepReport& report);
  void settle_ground(bool particles_changed);
  void refit_tree();
};

/// Boxes of the BVH are larger than their faces by this share of the spacing, so that most steps need no refit.
inline constexpr float kBoxMargin = 0.1f;

/// Vertices are marked dirty in runs of so many.
inline constexpr std::uint32_t kDirtyChunk = 64;

}  // namespace divot
