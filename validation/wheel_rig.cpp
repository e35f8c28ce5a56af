#include "validation/wheel_rig.h"

#include <algorithm>
#include <cmath>

#include "validation/simulate.h"

namespace divot::validation {
namespace {

constexpr double kWay = 2.4, kMargin = 0.8;               // m, of a pass; of ground on all sides of it
constexpr double kWheel = 30, kSetDown = 1, kTurn = 0.5;  // kg; s at rest before each pass
constexpr double kForce = 1e6;                            // N, N m: motors that do not give way

double time_of(const Rig& rig) { return kWay / rig.speed + kTurn; }

// Speed over time, to and fro.
Profile speeds(const Rig& rig, double speed) {
  std::vector<std::pair<double, double>> points;
  for (int k = 0; k < rig.passes; ++k) {
    const double start = kSetDown + k * time_of(rig), end = start + time_of(rig) - kTurn;
    const double now = k % 2 == 0 ? speed : -speed;
    points.insert(points.end(), {{start, 0}, {start + kTurn / 2, now}, {end, now}, {end + kTurn / 2, 0}});
  }
  return points;
}

Scene scene_of(const Material& ground, const Rig& rig) {
  Scene scene;
  scene.terrain.shape = GridTerrain{.columns = static_cast<int>((kWay + 2 * kMargin) / rig.spacing) + 1,
                                    .rows = static_cast<int>((rig.width + 2 * kMargin) / rig.spacing) + 1,
                                    .spacing = rig.spacing};
  scene.terrain.material = "ground";
  scene.materials = {ground};
  scene.materials.front().name = "ground";
  const double x = -kWay / 2, y = 0.37 * rig.spacing;
  scene.bodies = {
      {.name = "carriage", .shape = Box{{0.3, 0.3, 0.1}}, .mass = 100, .position = {x, y, 2 * rig.radius + 0.2}},
      {.name = "wheel", .shape = Cylinder{rig.radius, rig.width}, .mass = kWheel, .position = {x, y, rig.radius}}};
  Joint rail{.type = JointType::slider, .second = "carriage", .axis = {1, 0, 0}};
  rail.motor_speed = speeds(rig, rig.speed), rail.motor_force = kForce;
  Joint hub{.type = JointType::wheel, .first = "carriage", .second = "wheel", .stiffness = 1, .damping = 200};
  hub.preload = rig.load - kWheel * kGravity;
  if (rig.driven) hub.motor_speed = speeds(rig, rig.speed / rig.radius / (1 - rig.slip)), hub.motor_force = kForce;
  scene.joints = {rail, hub};
  return scene;
}

double rut_depth(const World& world, const Rig& rig) {
  double depth = 0;
  int count = 0;
  for (double x = -0.25 * kWay; x <= 0.25 * kWay; x += rig.spacing / 2)
    for (double y = -rig.width / 3; y <= rig.width / 3; y += rig.spacing / 2, ++count)
      depth -= world.ground_height(x, y);
  return depth / count;
}

}  // namespace

Result<std::vector<Pass>> run_rig(const Material& ground, const Rig& rig) {
  auto world = make_world(scene_of(ground, rig));
  if (!world) return tl::unexpected(world.error());
  std::vector<Pass> passes;
  for (int k = 0; k < rig.passes; ++k) {
    const double start = kSetDown + k * time_of(rig), way = kWay / rig.speed;
    run_to(*world, start + 0.4 * way);
    Pass pass;
    int count = 0;
    for (; world->time() < start + 0.85 * way; ++count) {
      world->step();
      pass.sinkage += rig.radius - world->bodies()[1].position.z;
      pass.pull -= (k % 2 == 0 ? 1 : -1) * world->joints()[0].motor_force;
    }
    pass.sinkage /= count, pass.pull /= count;
    run_to(*world, start + time_of(rig));
    pass.rut = rut_depth(*world, rig);
    passes.push_back(pass);
  }
  return passes;
}

}  // namespace divot::validation
