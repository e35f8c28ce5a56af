// Results belong to the ground, not to the mesh or the step: halving either moves them by less than 10 %.
#include <fmt/format.h>

#include <functional>

#include "validation/craters.h"
#include "validation/families.h"
#include "validation/simulate.h"

namespace divot::validation {
namespace {

constexpr double kTolerance = 0.10;

// Something that is measured on ground of some spacing with some step.
struct Measure {
  const char* name;
  const char* quantity;
  double spacing, dt;
  std::function<Result<double>(double spacing, double dt)> of;
};

Experiment halved(const Measure& measure, bool halves_spacing) {
  return {{{fmt::format("resolution/{}/{}", measure.name, halves_spacing ? "spacing" : "step"),
            "results do not depend on the mesh or the step",
            fmt::format("{}, {} halved over not", measure.quantity, halves_spacing ? "spacing" : "step"), "1", 1,
            kTolerance}},
          [=]() -> Result<Outcome> {
            const auto coarse = measure.of(measure.spacing, measure.dt);
            const auto fine = halves_spacing ? measure.of(measure.spacing / 2, measure.dt)
                                             : measure.of(measure.spacing, measure.dt / 2);
            if (!coarse) return tl::unexpected(coarse.error());
            if (!fine) return tl::unexpected(fine.error());
            return Outcome{{*fine / *coarse}};
          }};
}

Result<double> crater(double spacing, double dt, double Crater::*what) {
  const ScaledCrater& sand = kScaledCraters[0];
  Scene scene =
      bomb_scene(sand.material, kTon, 0, 10 * sand.radius, static_cast<int>(10 * sand.radius / spacing + 0.5));
  scene.dt = dt;
  const auto world = explode(scene);
  if (!world) return tl::unexpected(world.error());
  return world->craters().front().*what;
}

Scene ball(double spacing, double dt, double width, double length) {
  Scene scene = flat("dry_sand", 2 * static_cast<int>(width / 2 / spacing + 0.5) + 1, spacing);
  std::get<GridTerrain>(scene.terrain.shape).rows = 2 * static_cast<int>(length / 2 / spacing + 0.5) + 1;
  scene.dt = dt;
  scene.bodies = {{.name = "ball",
                   .shape = Sphere{.radius = 0.5},
                   .mass = 1000,
                   .position = {0.013, 0.007, 0},
                   .above_ground = true}};
  return scene;
}

Result<double> resting(double spacing, double dt) {
  const auto world = run(ball(spacing, dt, 1.6, 1.6), 2);
  if (!world) return tl::unexpected(world.error());
  return world->bodies().front().sinkage;
}

Result<double> dropped(double spacing, double dt) {
  Scene scene = ball(spacing, dt, 2, 2);
  scene.bodies.front().position.z = 2;
  const auto world = run(scene, 2);
  if (!world) return tl::unexpected(world.error());
  return world->bodies().front().max_sinkage;
}

// Other shapes, 300 kg, in other soils, from 1 m.
Result<double> fallen(const Shape& shape, const char* soil, double spacing, double dt) {
  Scene scene = ball(spacing, dt, 2, 2);
  scene.terrain.material = soil;
  auto& body = scene.bodies.front();
  body.shape = shape, body.mass = 300, body.position.z = 1;
  const auto world = run(scene, 2);
  if (!world) return tl::unexpected(world.error());
  return world->bodies().front().max_sinkage;
}

// How far it rolls in two seconds.
Result<double> rolling(double spacing, double dt) {
  Scene scene = ball(spacing, dt, 2, 14);
  scene.bodies.front().position.y = -6;
  scene.bodies.front().velocity = {0, 5, 0};
  scene.bodies.front().angular_velocity = {-10, 0, 0};
  const auto world = run(scene, 2);
  if (!world) return tl::unexpected(world.error());
  return world->bodies().front().position.y + 6;
}

}  // namespace

Result<std::vector<Experiment>> resolution(const Places&) {
  const double step = 1.0 / 60;
  const std::vector<Measure> measures = {
      {"crater_width", "crater width", 0.297, step, [](double s, double dt) { return crater(s, dt, &Crater::width); }},
      {"crater_depth", "crater depth", 0.297, step, [](double s, double dt) { return crater(s, dt, &Crater::depth); }},
      {"lip_height", "lip height", 0.297, step, [](double s, double dt) { return crater(s, dt, &Crater::lip_height); }},
      {"resting", "sinkage of a ball at rest", 0.05, step, &resting},
      {"dropped", "sinkage of a ball dropped from 2 m", 0.05, step, &dropped},
      {"dropped_box", "sinkage of a box dropped from 1 m on sandy loam", 0.05, step,
       [](double s, double dt) {
         return fallen(Box{{0.6, 0.8, 0.4}}, "sandy_loam", s, dt);
       }},
      {"dropped_cylinder", "sinkage of a lying cylinder dropped from 1 m on wheat field", 0.05, step,
       [](double s, double dt) {
         return fallen(Cylinder{0.4, 0.8}, "wheat_field", s, dt);
       }},
      {"dropped_capsule", "sinkage of a lying capsule dropped from 1 m on snow", 0.05, step,
       [](double s, double dt) {
         return fallen(Capsule{0.3, 0.6}, "snow", s, dt);
       }},
      {"dropped_cone", "sinkage of a cone dropped from 1 m on its base on mud", 0.05, step,
       [](double s, double dt) {
         return fallen(Cone{0.4, 0.6}, "mud", s, dt);
       }},
      {"rolling", "way of a ball that rolls for 2 s", 0.1, step, &rolling},
  };
  std::vector<Experiment> experiments;
  for (const Measure& measure : measures)
    for (const bool spacing : {true, false}) experiments.push_back(halved(measure, spacing));
  return experiments;
}

}  // namespace divot::validation
