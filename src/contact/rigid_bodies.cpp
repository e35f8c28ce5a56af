#include "contact/rigid_bodies.h"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <vector>

#include "contact/coupled_solver.h"
#include "contact/touches.h"

namespace divot::contact {
namespace {

btVector3 to_bullet(const Vec3d& v) { return {v.x, v.y, v.z}; }
btQuaternion to_bullet(const Quat& q) { return {q.x, q.y, q.z, q.w}; }
Vec3d from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

// Rounds of the solver at most, and the change of speed, m/s, that ends them.
constexpr int kIterations = 100;
constexpr double kStill = 1e-9;

// Bullet rounds corners of hulls by this share of their size.
constexpr double kHullMargin = 0.01;

std::unique_ptr<btCollisionShape> make_shape(const geometry::Piece& piece) {
  using Kind = geometry::Piece::Kind;
  switch (piece.kind) {
    case Kind::sphere:
      return std::make_unique<btSphereShape>(piece.radius);
    case Kind::box:
      return std::make_unique<btBoxShape>(to_bullet(piece.half));
    case Kind::cylinder:
      return std::make_unique<btCylinderShape>(btVector3{piece.radius, piece.half_length, piece.radius});
    case Kind::capsule:
      return std::make_unique<btCapsuleShape>(piece.radius, 2 * piece.half_length);
    case Kind::cone:
      return std::make_unique<btConeShapeZ>(piece.radius, 2 * piece.half_length);
    case Kind::hull:
      break;
  }
  auto hull = std::make_unique<btConvexHullShape>();
  double size = 0;
  for (const Vec3d& corner : piece.hull->corners) {
    hull->addPoint(to_bullet(corner), false);
    size = std::max(size, length(corner - piece.hull->corners[0]));
  }
  hull->recalcLocalAabb();
  hull->setMargin(kHullMargin * size);
  return hull;
}

}  // namespace

struct RigidBodies::Bullet {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  CoupledSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  Touches touches;

  // Of a solid: its piece, or a compound of its pieces.
  btCollisionShape* add_shape(const geometry::Solid& solid) {
    const auto place = [](const geometry::Piece& piece) {
      return btTransform(to_bullet(piece.rotation), to_bullet(piece.position));
    };
    const bool single =
        solid.pieces.size() == 1 && solid.pieces[0].position == Vec3d{} && solid.pieces[0].rotation == Quat{};
    if (single) return shapes.emplace_back(make_shape(solid.pieces[0])).get();
    auto compound = std::make_unique<btCompoundShape>();
    for (const geometry::Piece& piece : solid.pieces)
      compound->addChildShape(place(piece), shapes.emplace_back(make_shape(piece)).get());
    return shapes.emplace_back(std::move(compound)).get();
  }
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  std::vector<btVector3> corners;  // of rigid faces
  std::vector<int> indices;
  std::unique_ptr<btTriangleIndexVertexArray> faces;
  std::unique_ptr<btRigidBody> ground;

  Bullet() {
    world.setGravity({0, 0, 0});
    btContactSolverInfo& info = world.getSolverInfo();
    // All bodies in one call: joints are ours, so that Bullet's islands know nothing of them.
    info.m_minimumSolverBatchSize = 1 << 30;
    info.m_numIterations = kIterations;
    info.m_leastSquaresResidualThreshold = kStill;
  }
  ~Bullet() {
    for (auto& body : bodies) world.removeRigidBody(body.get());
    if (ground) world.removeRigidBody(ground.get());
  }

  // Bodies are where they are outside: nothing of their motion is kept here.
  void place(std::span<const state::Body> from) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      bodies[i]->setCenterOfMassTransform(btTransform(to_bullet(from[i].orientation), to_bullet(from[i].position)));
      bodies[i]->setLinearVelocity(to_bullet(from[i].velocity));
      bodies[i]->setAngularVelocity(to_bullet(from[i].angular_velocity));
    }
  }
};

RigidBodies::RigidBodies() : bullet_(std::make_unique<Bullet>()) {}
RigidBodies::~RigidBodies() = default;
RigidBodies::RigidBodies(RigidBodies&&) noexcept = default;
RigidBodies& RigidBodies::operator=(RigidBodies&&) noexcept = default;

void RigidBodies::add(const state::RigidFaces& faces, std::span<const Vec3> positions, const laws::Medium& medium) {
  Bullet& b = *bullet_;
  b.indices.assign(faces.triangles.begin(), faces.triangles.end());
  for (const Vec3& p : positions) b.corners.push_back(to_bullet(to_double(p)));
  b.faces = std::make_unique<btTriangleIndexVertexArray>(
      static_cast<int>(b.indices.size() / 3), b.indices.data(), static_cast<int>(3 * sizeof(int)),
      static_cast<int>(b.corners.size()), b.corners.data()->m_floats, static_cast<int>(sizeof(btVector3)));
  auto shape = std::make_unique<btBvhTriangleMeshShape>(b.faces.get(), true);
  shape->setMargin(0);
  btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, shape.get());
  info.m_restitution = medium.restitution;
  info.m_friction = medium.tan_friction;
  b.shapes.push_back(std::move(shape));
  b.ground = std::make_unique<btRigidBody>(info);
  b.ground->setUserIndex(Touches::kGround);
  b.world.addRigidBody(b.ground.get());
  std::vector<btVector3> normals;
  for (std::size_t k = 0; k < b.indices.size(); k += 3) {
    const auto corner = [&](std::size_t c) { return b.corners[static_cast<std::size_t>(b.indices[k + c])]; };
    normals.push_back((corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized());
  }
  b.touches.add_ground(*b.ground, std::move(normals));
}

void RigidBodies::add(const state::Body& body) {
  btRigidBody::btRigidBodyConstructionInfo info(body.mass, nullptr, bullet_->add_shape(*body.solid),
                                                to_bullet(body.inertia));
  info.m_restitution = body.restitution;
  info.m_friction = body.friction;
  info.m_startWorldTransform = btTransform(to_bullet(body.orientation), to_bullet(body.position));
  auto& rigid = bullet_->bodies.emplace_back(std::make_unique<btRigidBody>(info));
  rigid->setUserIndex(static_cast<int>(bullet_->bodies.size() - 1));
  // The soil decides when a body rests, not Bullet.
  rigid->setActivationState(DISABLE_DEACTIVATION);
  bullet_->world.addRigidBody(rigid.get());
  bullet_->touches.add(*rigid);
}

void RigidBodies::add(const state::HeldJoint& joint) {
  if (joint.settings.collide || joint.first == kNone) return;
  btRigidBody &first = *bullet_->bodies[joint.first], &second = *bullet_->bodies[joint.second];
  first.setIgnoreCollisionCheck(&second, true), second.setIgnoreCollisionCheck(&first, true);
}

std::optional<math::Row> RigidBodies::impulse(std::size_t body) const {
  return bullet_->solver.coupled(body) ? std::optional(bullet_->solver.impulse(body)) : std::nullopt;
}

void RigidBodies::advance(std::span<state::Body> bodies, std::span<ConstraintRow> rows,
                          std::span<const Resistance> resistance, double dt) {
  bullet_->place(bodies);
  Touches::clear(bullet_->dispatcher);
  bullet_->solver.prepare(rows, resistance, bullet_->touches);
  bullet_->world.stepSimulation(dt, 0);
  bullet_->touches.remember();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const btRigidBody& rigid = *bullet_->bodies[i];
    const btQuaternion q = rigid.getWorldTransform().getRotation();
    bodies[i].position = from_bullet(rigid.getWorldTransform().getOrigin());
    bodies[i].orientation = {q.x(), q.y(), q.z(), q.w()};
    bodies[i].velocity = from_bullet(rigid.getLinearVelocity());
    bodies[i].angular_velocity = from_bullet(rigid.getAngularVelocity());
  }
}

std::string RigidBodies::save() const { return bullet_->touches.save(); }
bool RigidBodies::restore(std::string_view bytes) { return bullet_->touches.restore(bytes); }

}  // namespace divot::contact
