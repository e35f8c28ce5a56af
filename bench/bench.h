#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cli/plot.h"
#include "divot/errors.h"
#include "divot/world.h"

namespace divot::bench {

/// What a benchmark measured of one way to run one scene. Times are medians over repeats.
struct Measurement {
  std::string name;  ///< `figure1/adaptive`
  std::size_t particles = 0;
  int threads = 1;
  std::size_t count = 0;  ///< of bodies, bombs or vertices, where that is what a benchmark varies
  int steps = 0;          ///< measured, where `stages` is their sum
  double ms_per_step = 0, ns_per_particle_step = 0;
  double cpu_ms_per_step = 0;   ///< of all threads together: what a shared machine leaves undisturbed; 0: not measured
  double real_time_factor = 0;  ///< simulated / wall
  std::vector<StageTime> stages;  ///< of all steps that were measured
  UpdateCounts updates;
  std::uint64_t state_hash = 0;
};

/// What a benchmark hands back.
struct Report {
  std::string text;  ///< tables for people
  std::vector<Measurement> results;
  std::vector<cli::BarChart> charts;
  std::vector<cli::CurveChart> line_charts;
};

/// What a benchmark is asked for.
struct Request {
  std::string scenes;            ///< folder of the scene files
  std::size_t most = 2'000'000;  ///< cases with more particles, vertices or bodies are left out
};

/// A benchmark by name. `run` fails when its scene cannot be used, or when what it measured is not what it claims to
/// measure.
struct Bench {
  const char* name;
  const char* what;
  Result<Report> (*run)(const Request& request);
};

/// Every benchmark.
std::span<const Bench> benches();

/// The paper's Figure 1: the parts of a second of simulation with 98 particles, by how often structures are brought up
/// to date.
Result<Report> figure1(const Request& request);

/// A step of a world with every particle awake: 100 to 2 million of them, Euler and RK4, one thread and two.
Result<Report> scaling(const Request& request);

/// One crater on ground of 10^4 to 10^7 vertices: time of a step, memory, loading.
Result<Report> terrain_size(const Request& request);

/// Error and cost of uniform grids and of new triangles where the ground deforms, by the number of triangles.
Result<Report> refinement(const Request& request);

/// 1 to 1000 rolling balls and 1 to 100 bombs on one ground.
Result<Report> bodies(const Request& request);

/// Spheres on soft soil beside what Chrono's SCM terrain takes for them.
Result<Report> rolling(const Request& request);

/// What LAMMPS, nanoflann, Embree and Bullet take for the same work, those that are there.
Result<Report> peers(const Request& request);

}  // namespace divot::bench
