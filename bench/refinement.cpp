#include <fmt/format.h>

#include <array>
#include <cmath>
#include <ctime>
#include <memory>
#include <optional>

#include "bench/stepping.h"
#include "divot/scene.h"

namespace divot::bench {
namespace {

// What is run on uniform grids, of which the last is what all else is held against, and on a coarse one that is
// refined.
struct Subject {
  const char* name;
  double wide, deep;          // m, of the ground
  double coarse;              // m, between the vertices that are refined
  std::vector<double> edges;  // m, of uniform grids, descending
  std::function<void(Scene&)> fill;
  std::function<std::vector<double>(const World&)> results;
};

void add_ball(Scene& scene) {
  scene.duration = 2;
  scene.bodies = {{.name = "ball",
                   .shape = Sphere{.radius = 0.6},
                   .mass = 600,
                   .position = {-5, 0.03, 0},
                   .above_ground = true,
                   .velocity = {3, 0, 0},
                   .angular_velocity = {0, 5, 0}}};
}

void add_bomb(Scene& scene) {
  scene.duration = 3;
  scene.bombs = {{.time = 0, .position = {1, 2, 0}, .yield = 5}};
}

void add_truck(const Request& request, Scene& scene) {
  if (const auto truck = load_scene(request.scenes + "/truck.toml"))
    scene.bodies = truck->bodies, scene.joints = truck->joints;
  scene.duration = 6;
  scene.terrain.material = "wheat_field";
}

// Mean depth and width at half of it, m, of the rut on the left, where all wheels have been: from a metre behind where
// the truck's rear wheels started to a metre before they are.
std::vector<double> rut_of(const World& world, double from, double to) {
  constexpr double kMiddle = 0.8, kBeside = 0.5, kStep = 0.01;
  double depth = 0, area = 0;
  int sections = 0;
  for (double x = from; x < to; x += 0.1, ++sections) {
    double deepest = 0, section = 0;
    for (double y = kMiddle - kBeside; y < kMiddle + kBeside; y += kStep) {
      const double sunk = std::max(0.0, -world.ground_height(x, y));
      deepest = std::max(deepest, sunk), section += kStep * sunk;
    }
    depth += deepest, area += section;
  }
  return {depth / sections, area / depth};
}

std::vector<Subject> subjects(const Request& request) {
  return {{"truck",
           32,
           16,
           1,
           {0.16, 0.08, 0.04, 0.02},
           [&](Scene& scene) { add_truck(request, scene); },
           [](const World& world) {
             const std::vector<BodyView> bodies = world.bodies();
             double sinkage = 0, rear = 1e9;
             for (std::size_t wheel = 1; wheel < bodies.size(); ++wheel) {
               sinkage = std::max(sinkage, bodies[wheel].max_sinkage);
               rear = std::min(rear, bodies[wheel].position.x);
             }
             std::vector<double> results = rut_of(world, -9.5, rear - 1);
             results.insert(results.end(), {sinkage, bodies[0].position.x + 9});
             return results;
           }},
          {"ball",
           48,
           22.4,
           3.2,
           {0.4, 0.2, 0.1, 0.05, 0.025},
           add_ball,
           [](const World& world) {
             const BodyView ball = world.bodies().front();
             return std::vector{ball.max_sinkage, ball.position.x + 5};
           }},
          {"crater", 256, 256, 32, {4, 2, 1, 0.5, 0.25}, add_bomb, [](const World& world) {
             const Crater crater = world.craters().front();
             return std::vector{crater.width, crater.depth};
           }}};
}

Scene scene_of(const Subject& subject, double spacing) {
  Scene scene;
  const auto count = [&](double length) { return static_cast<int>(std::lround(length / spacing)) + 1; };
  scene.terrain = {
      .shape = GridTerrain{.columns = count(subject.wide), .rows = count(subject.deep), .spacing = spacing},
      .material = "dry_sand"};
  subject.fill(scene);
  return scene;
}

// With default settings but for the least edge; with `half` as long a one as they ask for.
Scene refined(const Subject& subject, double min_edge, bool half = false) {
  Scene scene = scene_of(subject, subject.coarse);
  Refinement& refine = scene.terrain.refine;
  refine.min_edge = min_edge;
  // The chord between ground and body grows with the square of the edge, how far a crater turns with the edge.
  if (half) refine.error /= 4, refine.tolerance /= 4, refine.curvature /= 2;
  return scene;
}

struct Run {
  Measurement measurement;
  double cpu_s = 0;  // loading and all steps
  double edge = 0;   // m, of the finest triangles
  std::size_t vertices = 0;
  std::vector<double> results;
};

Result<Run> run(const Subject& subject, const std::string& kind, const Scene& scene) {
  const std::clock_t start = std::clock();
  auto world = World::create(scene, std::make_shared<const Jobs>(1));
  if (!world) return tl::unexpected(world.error());
  const int steps = static_cast<int>(std::lround(world->scene().duration / world->scene().dt));
  auto m = measure_steps(fmt::format("refinement/{}/{}", subject.name, kind), *world, {.warm_up = 0, .steps = steps});
  if (!m) return tl::unexpected(m.error());
  Run out;
  out.cpu_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  out.results = subject.results(*world);
  m->count = world->surface().triangles.size() / 3;
  const RefinementCounts counts = world->refinement();
  out.edge = world->surface().spacing;
  out.vertices = counts.on ? counts.base_vertices + counts.most : world->surface().positions.size();
  out.measurement = std::move(*m);
  return out;
}

constexpr int kRepeats = 3;

// The finest uniform grid and the ground refined by default, in turns; each with its median time.
struct Peers {
  Run finest, refined;
};

Result<Peers> run_peers(const Subject& subject) {
  const double least = subject.edges.back();
  std::vector<double> finest_s, refined_s;
  Peers peers;
  for (int k = 0; k < kRepeats; ++k) {
    auto finest = run(subject, fmt::format("uniform/{}", least), scene_of(subject, least));
    if (!finest) return tl::unexpected(finest.error());
    auto refined_ground = run(subject, "adaptive", refined(subject, least));
    if (!refined_ground) return tl::unexpected(refined_ground.error());
    finest_s.push_back(finest->cpu_s), refined_s.push_back(refined_ground->cpu_s);
    peers = {std::move(*finest), std::move(*refined_ground)};
  }
  peers.finest.cpu_s = median(finest_s), peers.refined.cpu_s = median(refined_s);
  return peers;
}

// The largest share by which a result is off.
double error_of(const std::vector<double>& results, const std::vector<double>& wanted) {
  double most = 0;
  for (std::size_t k = 0; k < results.size(); ++k)
    most = std::max(most, std::abs(results[k] - wanted[k]) / std::abs(wanted[k]));
  return most;
}

}  // namespace

Result<Report> refinement(const Request& request) {
  Report report;
  report.text = "refinement: the same answer by uniform grids and by new triangles on a coarse one\n";
  cli::CurveChart cost = curves("refinement_cost", "CPU time of a run, loading included, s", "triangles");
  cli::CurveChart error = curves("refinement_error", "Largest error against the finest uniform grid", "triangles");
  cost.y_label = "s", error.y_label = "error";
  for (Subject subject : subjects(request)) {
    std::erase_if(subject.edges, [&](double edge) {
      return subject.wide * subject.deep / (edge * edge) > static_cast<double>(request.most);
    });
    if (subject.edges.empty()) continue;
    report.text += fmt::format("{:<8} {:<14} {:>7} {:>10} {:>10} {:>9} {:>8}\n", "", "", "edge m", "vertices",
                               "triangles", "CPU s", "error");
    const auto peers = run_peers(subject);
    if (!peers) return tl::unexpected(peers.error());
    const Run &finest = peers->finest, &chosen = peers->refined;
    const auto put = [&](const Run& one, const char* kind, const char* curve) {
      const double off = error_of(one.results, finest.results);
      const auto triangles = static_cast<double>(one.measurement.count);
      report.text += fmt::format("{:<8} {:<14} {:>7.3f} {:>10} {:>10} {:>9.2f} {:>7.2f}%\n", subject.name, kind,
                                 one.edge, one.vertices, one.measurement.count, one.cpu_s, 100 * off);
      add_point(cost, fmt::format("{}, {}", subject.name, curve), triangles, one.cpu_s);
      if (off > 0) add_point(error, fmt::format("{}, {}", subject.name, curve), triangles, off);
      report.results.push_back(one.measurement);
    };
    const auto measure = [&](const std::string& kind, const char* curve, const Scene& scene) -> Result<void> {
      const auto one = run(subject, kind, scene);
      if (!one) return tl::unexpected(one.error());
      put(*one, kind.c_str(), curve);
      return {};
    };
    const double least = subject.edges.back();
    put(finest, fmt::format("uniform/{}", least).c_str(), "uniform");
    for (auto edge = subject.edges.rbegin() + 1; edge != subject.edges.rend(); ++edge)
      if (const auto done = measure(fmt::format("uniform/{}", *edge), "uniform", scene_of(subject, *edge)); !done)
        return tl::unexpected(done.error());
    if (const auto done = measure("adaptive/half", "adaptive", refined(subject, least, true)); !done)
      return tl::unexpected(done.error());
    put(chosen, "adaptive", "adaptive");
    // Coarser than what is wanted, as a limit makes it.
    for (auto edge = subject.edges.rbegin(); edge != subject.edges.rend(); ++edge) {
      if (*edge <= 1.01 * chosen.edge) continue;
      if (const auto done = measure(fmt::format("adaptive/{}", *edge), "adaptive", refined(subject, *edge)); !done)
        return tl::unexpected(done.error());
    }
    report.text += fmt::format(
        "{:<8} by default: error {:.1f} %, 1/{:.0f} of the vertices, 1/{:.1f} of the time (medians of {} runs each)\n",
        subject.name, 100 * error_of(chosen.results, finest.results),
        static_cast<double>(finest.vertices) / static_cast<double>(chosen.vertices), finest.cpu_s / chosen.cpu_s,
        kRepeats);
  }
  report.line_charts = {cost, error};
  return report;
}

}  // namespace divot::bench
