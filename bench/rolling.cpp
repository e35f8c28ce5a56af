#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "bench/stepping.h"

namespace divot::bench {
namespace {

// What Chrono's SCM terrain takes for a step of its own, berms off and on, one thread: measured beside divot on the
// same two shared cores with Chrono at commit 7689fbc, g++ 12 -O3 -march=native; two digits.
struct Peer {
  int spheres;
  double without_berms_ms, with_berms_ms;
};
struct Setup {
  const char* scene;
  double lane;  // m of ground for each sphere
  std::array<Peer, 3> peers;
};
constexpr std::array<Setup, 2> kSetups = {
    Setup{"rolling_5cm", 4, {Peer{1, 1.40, 1.59}, Peer{10, 17.4, 28.4}, Peer{100, 215, 340}}},
    Setup{"rolling_2cm", 4, {Peer{1, 8.6, 10.5}, Peer{0, 0, 0}, Peer{0, 0, 0}}}};

// The file's sphere with what keeps its speed, and as many more beside it, each on ground of its own.
Scene widened(Scene scene, int spheres, double lane) {
  auto& grid = std::get<GridTerrain>(scene.terrain.shape);
  grid.rows = static_cast<int>(std::lround(spheres * lane / grid.spacing)) + 1;
  const auto bodies = std::exchange(scene.bodies, {});
  const auto joints = std::exchange(scene.joints, {});
  const auto numbered = [](const std::string& name, int k) {
    return name.empty() ? name : fmt::format("{} {}", name, k + 1);
  };
  for (int k = 0; k < spheres; ++k) {
    for (BodySettings body : bodies) {
      body.name = numbered(body.name, k);
      body.position.y = lane * (k - 0.5 * (spheres - 1));
      scene.bodies.push_back(body);
    }
    for (Joint joint : joints) {
      joint.name = numbered(joint.name, k);
      joint.first = numbered(joint.first, k), joint.second = numbered(joint.second, k);
      scene.joints.push_back(joint);
    }
  }
  return scene;
}

// One sphere drives on and on over ground of its own: a second from the start and one after `kDrive`, s. What it costs
// must not grow with what it has touched.
Result<std::string> drive(const Scene& file, Report& report) {
  constexpr double kDrive = 10, kLength = 80;  // s, m
  constexpr int kWarmUp = 100, kSteps = 400;
  Scene scene = widened(file, 1, 4);
  auto& grid = std::get<GridTerrain>(scene.terrain.shape);
  grid.columns = static_cast<int>(std::lround(kLength / grid.spacing)) + 1;
  for (BodySettings& body : scene.bodies) body.position.x = -0.5 * kLength + 3;
  auto world = World::create(scene, std::make_shared<const Jobs>(1));
  if (!world) return tl::unexpected(world.error());
  std::string text;
  for (int k = 0; k < 2; ++k) {
    while (k == 1 && world->time() < kDrive) world->step();
    auto m = measure_steps(k == 0 ? "rolling/drive_first" : "rolling/drive_last", *world,
                           {.warm_up = k == 0 ? kWarmUp : 0, .steps = kSteps});
    if (!m) return tl::unexpected(m.error());
    m->count = 1;
    const BodyView sphere = world->bodies().front();
    text += fmt::format(
        "driving, {:.0f} s and {:.0f} m: {:.2f} ms CPU a step at {:.1f} m/s, {} particles: {:.0f} ns each\n",
        world->time(), sphere.position.x - scene.bodies[0].position.x, m->cpu_ms_per_step, length(sphere.velocity),
        m->particles, 1e6 * m->cpu_ms_per_step / static_cast<double>(m->particles));
    report.results.push_back(std::move(*m));
  }
  return text;
}

}  // namespace

Result<Report> rolling(const Request& request) {
  Report report;
  std::string beside;
  for (const Setup& setup : kSetups) {
    const auto file = std::filesystem::path(request.scenes) / fmt::format("{}.toml", setup.scene);
    const auto scene = load_scene(file.string());
    if (!scene) return tl::unexpected(scene.error());
    for (const Peer& peer : setup.peers) {
      if (peer.spheres == 0 || static_cast<std::size_t>(peer.spheres) > request.most) continue;
      auto world = World::create(widened(*scene, peer.spheres, setup.lane), std::make_shared<const Jobs>(1));
      if (!world) return tl::unexpected(world.error());
      auto m = measure_steps(fmt::format("rolling/{}", setup.scene), *world, {.warm_up = 50, .steps = 100});
      if (!m) return tl::unexpected(m.error());
      m->count = static_cast<std::size_t>(peer.spheres);
      const BodyView sphere = world->bodies().front();
      beside += fmt::format(
          "{} x {}: {:.2f} ms CPU a step at {:.1f} m/s, {:.0f} mm deep; Chrono SCM {} ms, with berms {} ms: {:.0f} and "
          "{:.0f} times\n",
          m->count, setup.scene, m->cpu_ms_per_step, length(sphere.velocity), 1e3 * sphere.sinkage,
          peer.without_berms_ms, peer.with_berms_ms, peer.without_berms_ms / m->cpu_ms_per_step,
          peer.with_berms_ms / m->cpu_ms_per_step);
      report.results.push_back(std::move(*m));
    }
  }
  const auto file = std::filesystem::path(request.scenes) / fmt::format("{}.toml", kSetups[0].scene);
  const auto scene = load_scene(file.string());
  if (!scene) return tl::unexpected(scene.error());
  const auto driven = drive(*scene, report);
  if (!driven) return tl::unexpected(driven.error());
  beside += *driven;
  report.text = "rolling: spheres of 2000 kg on soft soil, as Chrono's SCM terrain is run\n" +
                table(report.results, "spheres") + beside;
  cli::CurveChart chart = curves("rolling", "A step of 2 ms by spheres, one thread", "spheres");
  for (const Measurement& m : report.results)
    if (m.name.find("drive") == std::string::npos)
      add_point(chart, m.name, static_cast<double>(m.count), m.ms_per_step);
  for (const Peer& peer : kSetups[0].peers)
    add_point(chart, "Chrono SCM, 5 cm, with berms", peer.spheres, peer.with_berms_ms);
  report.line_charts.push_back(chart);
  return report;
}

}  // namespace divot::bench
