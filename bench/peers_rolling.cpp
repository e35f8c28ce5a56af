#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <btBulletDynamicsCommon.h>

#include <ctime>
#include <filesystem>

#include "bench/peers.h"
#include "bench/stepping.h"

namespace divot::bench {
namespace {

// Bullet's ball on a rigid height field of the scene's grid: nothing sinks and nothing is pushed.
PeerTime bullet(const Scene& scene, int steps) {
  const auto& grid = std::get<GridTerrain>(scene.terrain.shape);
  const BodySettings& ball = scene.bodies.at(0);
  const double radius = std::get<Sphere>(ball.shape).radius;
  std::vector<float> heights(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows), 0.0f);
  btHeightfieldTerrainShape ground(grid.columns, grid.rows, heights.data(), 1, -1, 1, 2, PHY_FLOAT, false);
  ground.setLocalScaling(btVector3(grid.spacing, grid.spacing, 1));
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, -9.81));
  btRigidBody terrain(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &ground));
  world.addRigidBody(&terrain);
  btSphereShape sphere(radius);
  btVector3 inertia;
  sphere.calculateLocalInertia(ball.mass, inertia);
  btRigidBody body(btRigidBody::btRigidBodyConstructionInfo(ball.mass, nullptr, &sphere, inertia));
  body.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(ball.position.x, ball.position.y, radius)));
  body.setLinearVelocity(btVector3(ball.velocity.x, 0, 0));
  body.setAngularVelocity(btVector3(0, ball.velocity.x / radius, 0));
  body.setActivationState(DISABLE_DEACTIVATION);
  world.addRigidBody(&body);
  const auto seconds = static_cast<float>(scene.dt);
  PeerTime time{.task = "rolling ball", .who = "Bullet, rigid ground", .count = 1, .each = "step"};
  const std::clock_t start = std::clock();
  for (int k = 0; k < steps; ++k) world.stepSimulation(seconds, 0);
  time.ns = 1e9 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / steps;
  world.removeRigidBody(&body);
  world.removeRigidBody(&terrain);
  return time;
}

}  // namespace

Result<void> compare_rolling(const std::string& scenes, std::vector<PeerTime>& times) {
  constexpr int kSteps = 500;
  const auto scene = load_scene((std::filesystem::path(scenes) / "rolling_5cm.toml").string());
  if (!scene) return tl::unexpected(scene.error());
  const auto m = measure_steps("rolling", *scene, {.warm_up = 50, .steps = kSteps});
  if (!m) return tl::unexpected(m.error());
  times.push_back({"rolling ball", "divot", 1e6 * m->cpu_ms_per_step, 1, "step, on soil that deforms", {}});
  times.push_back(bullet(*scene, kSteps));
  return {};
}

}  // namespace divot::bench
