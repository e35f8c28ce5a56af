#pragma once

#include <functional>

#include "divot/world.h"

// What experiments have in common: worlds, and what is read from them through the public interface.
namespace divot::validation {

/// The scene's world on the calling thread alone.
Result<World> make_world(const Scene& scene);

void run_to(World& world, double time);

/// Runs the scene to `time`.
Result<World> run(const Scene& scene, double time);

/// Runs the scene until its bodies rest, which soft soil damps slowly, or for 20 s.
Result<World> run_to_rest(const Scene& scene);

/// A flat grid of square cells of one material, centred on the origin. `size`: vertices along each side.
Scene flat(const std::string& material, int size, double spacing);

/// The x between `low` and `high` at which a rising function is zero.
double solve(double low, double high, const std::function<double(double)>& rising);

/// Slope of the straight line that fits best through logarithms: the exponent of a power law. At least two points above
/// zero.
double fitted_exponent(const std::vector<std::pair<double, double>>& points);

inline constexpr double kGravity = 9.81;  ///< m/s^2, that of scenes
inline constexpr double kTon = 1000;      ///< kg

}  // namespace divot::validation
