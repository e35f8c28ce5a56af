#include "contact/rigid_bodies.h"

#include <btBulletDynamicsCommon.h>

#include <vector>

namespace divot::contact {
namespace {

btVector3 to_bullet(const Vec3d& v) { return {v.x, v.y, v.z}; }
Vec3d from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

struct RigidBodies::Bullet {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;

  Bullet() { world.setGravity({0, 0, 0}); }
  ~Bullet() {
    for (auto& body : bodies) world.removeRigidBody(body.get());
  }
};

RigidBodies::RigidBodies() : bullet_(std::make_unique<Bullet>()) {}
RigidBodies::~RigidBodies() = default;
RigidBodies::RigidBodies(RigidBodies&&) noexcept = default;
RigidBodies& RigidBodies::operator=(RigidBodies&&) noexcept = default;

void RigidBodies::add(const state::Body& body) {
  auto& shape = bullet_->shapes.emplace_back(std::make_unique<btSphereShape>(body.radius));
  btRigidBody::btRigidBodyConstructionInfo info(body.mass, nullptr, shape.get(),
                                                {body.inertia, body.inertia, body.inertia});
  info.m_restitution = body.restitution;
  info.m_friction = body.friction;
  info.m_startWorldTransform.setIdentity();
  info.m_startWorldTransform.setOrigin(to_bullet(body.position));
  auto& rigid = bullet_->bodies.emplace_back(std::make_unique<btRigidBody>(info));
  // The soil decides when a body rests, not Bullet.
  rigid->setActivationState(DISABLE_DEACTIVATION);
  bullet_->world.addRigidBody(rigid.get());
}

void RigidBodies::advance(std::span<state::Body> bodies, double dt) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bullet_->bodies[i]->setLinearVelocity(to_bullet(bodies[i].velocity));
    bullet_->bodies[i]->setAngularVelocity(to_bullet(bodies[i].angular_velocity));
  }
  bullet_->world.stepSimulation(dt, 0);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const btRigidBody& rigid = *bullet_->bodies[i];
    const btQuaternion q = rigid.getWorldTransform().getRotation();
    bodies[i].position = from_bullet(rigid.getWorldTransform().getOrigin());
    bodies[i].orientation = {q.x(), q.y(), q.z(), q.w()};
    bodies[i].velocity = from_bullet(rigid.getLinearVelocity());
    bodies[i].angular_velocity = from_bullet(rigid.getAngularVelocity());
  }
}

}  // namespace divot::contact
