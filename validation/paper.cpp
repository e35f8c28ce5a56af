// The paper's own numbers: its equations evaluated, and its scene run.
#include <chrono>
#include <cmath>
#include <filesystem>

#include "divot/blast.h"
#include "validation/families.h"
#include "validation/simulate.h"

namespace divot::validation {
namespace {

constexpr const char* kPaper = "Dvorak & Drahansky (2008)";
constexpr const char* kEvaluated = "Dvorak & Drahansky (2008), evaluated by hand";
constexpr double kDigits = 1e-4, kFourDigits = 5e-4;  // as many as are quoted

double decibel(double pressure) { return 20 * std::log10(pressure / 2e-5); }

// Eq. 11: the shock at which both waves are equal.
double equal_waves() {
  const double yield = solve(0.01, 10, [](double n) {
    const BlastSource source = blast_source(n);
    return source.blast_wave - source.shock;
  });
  return decibel(blast_source(yield).shock);
}

Experiment equations() {
  const auto number = [](const char* what, const char* source, const char* quantity, const char* unit, double value,
                         double tolerance = kDigits) {
    return Case{std::string("paper/") + what, source, quantity, unit, value, tolerance};
  };
  return {{number("shock_1t", kPaper, "shock of 1 t, eq. 9", "dB", 210.6),
           number("shock_1t_pressure", kEvaluated, "shock of 1 t, eq. 8", "Pa", 677688),
           number("blast_wave_1t", kEvaluated, "blast wave of 1 t, eq. 11", "Pa", 827818),
           number("total_1t", kEvaluated, "total pressure of 1 t, eq. 12", "MPa", 1.50551),
           number("width_1t", kPaper, "crater width of 1 t, eq. 10", "m", 7.13232),
           number("shock_5000t", kEvaluated, "shock of 5000 t, eq. 9", "dB", 235.2721),
           number("blast_wave_5000t", kEvaluated, "blast wave of 5000 t, eq. 11", "MPa", 27.3409),
           number("total_5000t", kEvaluated, "total pressure of 5000 t, eq. 12", "MPa", 38.9456),
           number("width_5000t", kEvaluated, "crater width of 5000 t, eq. 10", "m", 121.961),
           number("equal_waves", kPaper, "shock that its blast wave equals, eq. 11", "dB", 207.46),
           number("force_10m", kEvaluated, "force on one of 98 particles 10 m from 5000 t, eq. 14", "MN", 1.108,
                  kFourDigits)},
          []() -> Result<Outcome> {
            const BlastSource one = blast_source(1), many = blast_source(5000);
            return Outcome{{one.shock_db, one.shock, one.blast_wave, 1e-6 * one.total, one.crater_width, many.shock_db,
                            1e-6 * many.blast_wave, 1e-6 * many.total, many.crater_width, equal_waves(),
                            1e-6 * blast_force(5000, 10, 98)}};
          }};
}

double heading_deg(const Vec3d& velocity) { return std::atan2(velocity.y, velocity.x) * 180 / std::acos(-1.0); }

// Vertices within the crater of eq. 10 around a bomb.
double vertices_within(const World& world, const BombView& bomb) {
  const SurfaceView ground = world.surface();
  double count = 0;
  for (const Vec3& p : ground.positions)
    count += std::hypot(p.x + ground.origin.x - bomb.position.x, p.y + ground.origin.y - bomb.position.y) <=
             0.5 * blast_source(bomb.yield).crater_width;
  return count;
}

Experiment scene_run(const Places& places) {
  const std::string path = (std::filesystem::path(places.scenes) / "paper.toml").string();
  return {{{"paper/triangles", kPaper, "triangles of its terrain", "1", 2808},
           {"paper/particles", kPaper, "particles of the crater of 5000 t", "1", 98, 0.02},
           {"paper/scene_width", kPaper, "crater width in its scene, eq. 10", "m", 121.961, 0.1},
           {"paper/heading", kPaper, "turn of the sphere's heading by the crater", "degrees", 10, 0, Bound::at_least},
           {"paper/real_time", kPaper, "simulated over wall-clock time", "1", 1, 0, Bound::at_least}},
          [path]() -> Result<Outcome> {
            auto scene = load_scene(path);
            if (!scene) return tl::unexpected(scene.error());
            Scene without = *scene;
            without.bombs.clear();
            auto world = make_world(*scene), plain = make_world(without);
            if (!world) return tl::unexpected(world.error());
            if (!plain) return tl::unexpected(plain.error());
            const double triangles = static_cast<double>(world->surface().triangles.size()) / 3;
            const double particles = vertices_within(*world, world->bombs().front());
            const auto start = std::chrono::steady_clock::now();
            run_to(*world, scene->duration);
            const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            run_to(*plain, scene->duration);
            const double turn =
                std::abs(heading_deg(world->bodies().front().velocity) - heading_deg(plain->bodies().front().velocity));
            return Outcome{{triangles, particles, world->craters().front().width, std::min(turn, 360 - turn),
                            scene->duration / wall}};
          }};
}

}  // namespace

Result<std::vector<Experiment>> paper(const Places& places) { return std::vector{equations(), scene_run(places)}; }

}  // namespace divot::validation
