#pragma once

// What several test files need: random numbers with a fixed seed, surfaces, sheets of particles, scenes and worlds.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "divot/divot.h"
#include "forces/evaluate.h"
#include "laws/medium.h"
#include "neighbours/neighbours.h"
#include "source_dir.h"
#include "state/motion.h"
#include "state/particles.h"
#include "state/soil.h"
#include "state/surface.h"
#include "terrain/grid.h"

namespace divot::test {

/// Uniform numbers that are the same on every machine.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  /// In [low, high). Not std::uniform_real_distribution, whose numbers differ between libraries.
  double in(double low, double high) { return low + (high - low) * static_cast<double>(engine_()) / 4294967296.0; }
  float in(float low, float high) {
    return static_cast<float>(in(static_cast<double>(low), static_cast<double>(high)));
  }
  std::uint32_t below(std::size_t n) { return static_cast<std::uint32_t>(engine_() % n); }

 private:
  std::mt19937 engine_;
};

inline double degrees(double radians) { return radians * 180 / std::numbers::pi; }
inline double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// A grid of vertices around the origin.
inline state::Surface make_surface(const GridTerrain& grid) {
  auto surface = terrain::load_grid(grid, 1'000'000);
  EXPECT_TRUE(surface.has_value());
  return std::move(*surface);
}

/// Every vertex of a surface as a free particle at rest, with its column of soil.
struct Sheet {
  state::Surface surface;
  state::Soil soil;
  state::Particles particles;
  state::Bonds bonds;
  neighbours::Index index;
  std::vector<laws::Medium> media;

  state::MotionView motion() {
    state::Particles& p = particles;
    return {p.x, p.y, p.z, p.vx, p.vy, p.vz};
  }
};

inline Sheet make_sheet(const GridTerrain& grid, const std::vector<Material>& materials = {Material{}}) {
  Sheet s{.surface = make_surface(grid)};
  for (const Material& material : materials) s.media.push_back(laws::make_medium(material));
  state::Particles& p = s.particles;
  const std::size_t count = s.surface.position.size();
  p.for_each_array([&](auto& array) { array.resize(count); });
  for (std::uint32_t v = 0; v < count; ++v) {
    p.vertex[v] = v;
    p.column[v] = state::touch_column(s.surface, s.soil, v);
    s.soil.particle[p.column[v]] = v;
    p.set_position(v, s.surface.position[v]);
    p.material[v] = s.surface.material[v];
    p.mass[v] = s.media[p.material[v]].areal_mass * s.soil.cell[p.column[v]];
    p.hold[v] = Hold::free;
  }
  return s;
}

/// Bonds yield, form and break as they do where a substep starts.
inline void renew(state::Particles& p, state::Bonds& bonds, const state::Soil& soil,
                  std::span<const laws::Medium> media, float cutoff, Cohesion cohesion = Cohesion::lennard_jones) {
  forces::Scratch scratch;
  const forces::Field field{soil, media, {}, cohesion, cutoff, {1e18f}};
  forces::evaluate(p, bonds, {p.x, p.y, p.z, p.vx, p.vy, p.vz}, 0, field, forces::Renew::yes, scratch, Jobs(1));
}

/// Bonds between all that are within `cutoff` where they are, at rest as they are.
inline void bond(Sheet& s, float cutoff) {
  const neighbours::Reach reach{cutoff, 0.2f * cutoff, Neighbours::grid, {}};
  neighbours::update(s.particles, s.bonds, s.index, reach, true, Jobs(1));
  renew(s.particles, s.bonds, s.soil, s.media, cutoff);
}

/// The paper's scene, section 4, as the repository has it.
inline Scene paper_scene() {
  const auto scene = load_scene(std::string(source_dir()) + "/scenes/paper.toml");
  EXPECT_TRUE(scene.has_value());
  return *scene;
}

/// A world that must come to be.
inline World make_world(const Scene& scene, int threads = 1) {
  auto world = World::create(scene, std::make_shared<const Jobs>(threads));
  if (!world) ADD_FAILURE() << world.error().front().text();
  return std::move(*world);
}

/// Steps until `time`, s.
inline void run_to(World& world, double time) {
  while (world.time() < time - 0.5 * world.scene().dt) world.step();
}

/// How many particles are awake and no anchors.
inline std::size_t awake(const World& world) {
  std::size_t count = 0;
  for (const Hold hold : world.particles().hold) count += hold != Hold::anchor;
  return count;
}

/// Are all numbers a caller can see numbers?
inline bool all_finite(const World& world) {
  for (const Vec3& p : world.surface().positions)
    if (!is_finite(p)) return false;
  for (const BodyView& b : world.bodies())
    if (!is_finite(b.position) || !is_finite(b.velocity) || !is_finite(b.angular_velocity)) return false;
  const ParticleView p = world.particles();
  for (std::size_t i = 0; i < p.x.size(); ++i)
    if (!is_finite(Vec3{p.x[i], p.y[i], p.z[i]}) || !is_finite(Vec3{p.vx[i], p.vy[i], p.vz[i]})) return false;
  return true;
}

}  // namespace divot::test
