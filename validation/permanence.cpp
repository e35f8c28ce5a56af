// Ruts and craters do not creep back.
#include <algorithm>

#include "validation/craters.h"
#include "validation/families.h"
#include "validation/simulate.h"

namespace divot::validation {
namespace {

constexpr double kMinute = 60;  // s
constexpr double kLeft = 0.95;

// Deepest place of the ground, m.
double deepest(const World& world) {
  float most = 0;
  for (std::uint32_t v = 0; v < world.surface().positions.size(); ++v) most = std::max(most, world.sinkage(v));
  return static_cast<double>(most);
}

Experiment rut(const char* material) {
  return {{{std::string("permanence/rut/") + material, "ruts stay", "depth of a rut a minute later over what it was",
            "1", kLeft, 0, Bound::at_least}},
          [=]() -> Result<Outcome> {
            Scene scene = flat(material, 121, 0.05);
            std::get<GridTerrain>(scene.terrain.shape).columns = 41;
            scene.bodies = {{.name = "ball",
                             .shape = Sphere{.radius = 0.5},
                             .mass = 600,
                             .position = {0, -2, 0},
                             .above_ground = true,
                             .velocity = {0, 12, 0},
                             .angular_velocity = {-24, 0, 0}}};
            auto world = make_world(scene);
            if (!world) return tl::unexpected(world.error());
            // It rolls over the border and is gone.
            while (world->time() < 5 && !world->bodies().front().off_terrain) world->step();
            if (!world->bodies().front().off_terrain)
              return fail({.key = material, .problem = "the ball stays on the ground"});
            run_to(*world, world->time() + 0.05);
            const double before = deepest(*world);
            run_to(*world, world->time() + kMinute);
            return Outcome{{deepest(*world) / before}};
          }};
}

Experiment crater() {
  return {{{"permanence/crater", "craters stay", "depth of a crater a minute later over what it was", "1", kLeft, 0,
            Bound::at_least}},
          []() -> Result<Outcome> {
            auto world = explode(bomb_scene("dry_sand", kTon, 0, 10 * kScaledCraters[0].radius));
            if (!world) return tl::unexpected(world.error());
            const double before = deepest(*world);
            run_to(*world, world->time() + kMinute);
            return Outcome{{deepest(*world) / before}};
          }};
}

}  // namespace

Result<std::vector<Experiment>> permanence(const Places&) { return std::vector{rut("dry_sand"), rut("mud"), crater()}; }

}  // namespace divot::validation
