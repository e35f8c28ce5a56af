#include "validation/simulate.h"

#include <algorithm>
#include <cmath>

namespace divot::validation {

Result<World> make_world(const Scene& scene) { return World::create(scene, std::make_shared<const Jobs>(1)); }

void run_to(World& world, double time) {
  while (world.time() < time - 1e-9) world.step();
}

Result<World> run(const Scene& scene, double time) {
  auto world = make_world(scene);
  if (world) run_to(*world, time);
  return world;
}

Result<World> run_to_rest(const Scene& scene) {
  constexpr double kSetDown = 2, kLongest = 20, kStill = 2e-4;  // s, s, m/s
  auto world = run(scene, kSetDown);
  if (!world) return world;
  const auto moves = [&] {
    const auto bodies = world->bodies();
    return std::any_of(bodies.begin(), bodies.end(), [](const BodyView& b) { return length(b.velocity) > kStill; });
  };
  while (world->time() < kLongest && moves()) world->step();
  return world;
}

Scene flat(const std::string& material, int size, double spacing) {
  Scene scene;
  scene.terrain.shape = GridTerrain{.columns = size, .rows = size, .spacing = spacing};
  scene.terrain.material = material;
  return scene;
}

double solve(double low, double high, const std::function<double(double)>& rising) {
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (rising(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double fitted_exponent(const std::vector<std::pair<double, double>>& points) {
  double mean_x = 0, mean_y = 0;
  for (const auto& [x, y] : points) mean_x += std::log(x), mean_y += std::log(y);
  mean_x /= static_cast<double>(points.size()), mean_y /= static_cast<double>(points.size());
  double above = 0, below = 0;
  for (const auto& [x, y] : points) {
    above += (std::log(x) - mean_x) * (std::log(y) - mean_y);
    below += (std::log(x) - mean_x) * (std::log(x) - mean_x);
  }
  return above / below;
}

}  // namespace divot::validation
