#include <fmt/format.h>

#include <array>
#include <cmath>
#include <ctime>
#include <memory>

#include "bench/stepping.h"

namespace divot::bench {
namespace {

// Edges of uniform grids and of the finest new triangles, m, for coarse grids of 8 cells to an edge of the first; the
// last uniform one is what the others are held against.
struct Subject {
  const char* name;
  double wide, deep;  // m, of the ground
  std::array<double, 5> edges;
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
  scene.terrain.refine.curvature = 0.001;  // as fine as min_edge says
  scene.bombs = {{.time = 0, .position = {1, 2, 0}, .yield = 5}};
}

const std::array<Subject, 2>& subjects() {
  static const std::array<Subject, 2> kSubjects = {
      Subject{"ball",
              48,
              22.4,
              {0.4, 0.2, 0.1, 0.05, 0.025},
              &add_ball,
              [](const World& world) {
                const BodyView ball = world.bodies().front();
                return std::vector{ball.max_sinkage, ball.position.x + 5};
              }},
      Subject{"crater", 256, 256, {4, 2, 1, 0.5, 0.25}, &add_bomb, [](const World& world) {
                const Crater crater = world.craters().front();
                return std::vector{crater.width, crater.depth};
              }}};
  return kSubjects;
}

Scene scene_of(const Subject& subject, double spacing, double min_edge) {
  Scene scene;
  const auto count = [&](double length) { return static_cast<int>(std::lround(length / spacing)) + 1; };
  scene.terrain = {
      .shape = GridTerrain{.columns = count(subject.wide), .rows = count(subject.deep), .spacing = spacing},
      .material = "dry_sand"};
  subject.fill(scene);
  scene.terrain.refine.min_edge = min_edge;
  return scene;
}

struct Run {
  Measurement measurement;
  double cpu_s = 0;  // loading and all steps
  double edge = 0;   // m, of the finest triangles
  std::size_t vertices = 0;
  std::vector<double> results;
};

Result<Run> run(const Subject& subject, const char* kind, double spacing, double min_edge) {
  const std::clock_t start = std::clock();
  auto world = World::create(scene_of(subject, spacing, min_edge), std::make_shared<const Jobs>(1));
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
  report.text =
      "refinement: the same answer by uniform grids and by new triangles on a grid eight times as coarse as the "
      "coarsest\n";
  cli::CurveChart cost = curves("refinement_cost", "CPU time of a run, loading included, s", "triangles");
  cli::CurveChart error = curves("refinement_error", "Largest error against the finest uniform grid", "triangles");
  cost.y_label = "s", error.y_label = "error";
  for (const Subject& subject : subjects()) {
    const double coarse = 8 * subject.edges[0];
    std::vector<double> wanted;
    report.text += fmt::format("{:<8} {:<9} {:>7} {:>10} {:>10} {:>9} {:>8}\n", "", "", "edge m", "vertices",
                               "triangles", "CPU s", "error");
    for (auto edge = subject.edges.rbegin(); edge != subject.edges.rend(); ++edge)
      for (const bool refined : {false, true}) {
        const char* kind = refined ? "adaptive" : "uniform";
        const double cells = subject.wide * subject.deep / (*edge * *edge);
        if (cells > static_cast<double>(request.most)) continue;
        auto one = run(subject, kind, refined ? coarse : *edge, refined ? *edge : 0);
        if (!one) return tl::unexpected(one.error());
        // Bodies want no finer edge than shows what they touch.
        if (one->edge > 1.01 * *edge) continue;
        if (wanted.empty()) wanted = one->results;
        const double off = error_of(one->results, wanted);
        const std::string curve = fmt::format("{}, {}", subject.name, kind);
        const auto triangles = static_cast<double>(one->measurement.count);
        report.text += fmt::format("{:<8} {:<9} {:>7.3f} {:>10} {:>10} {:>9.2f} {:>7.2f}%\n", subject.name, kind, *edge,
                                   one->vertices, one->measurement.count, one->cpu_s, 100 * off);
        add_point(cost, curve, triangles, one->cpu_s);
        if (off > 0) add_point(error, curve, triangles, off);
        report.results.push_back(std::move(one->measurement));
      }
  }
  report.line_charts = {cost, error};
  return report;
}

}  // namespace divot::bench
