#include "contact/coupled_solver.h"

#include <algorithm>
#include <cmath>

namespace divot::contact {
namespace {

Vec3d from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
btVector3 to_bullet(const Vec3d& v) { return {v.x, v.y, v.z}; }

}  // namespace

void CoupledSolver::prepare(std::span<ConstraintRow> joints, std::span<const Resistance> bodies, Touches& touches) {
  touches_ = &touches;
  joints_ = joints;
  resistance_ = bodies;
  state_.resize(bodies.size());
  for (BodyState& s : state_) s.impulse = {}, s.coupled = false, s.slot = -1;
}

std::uint32_t CoupledSolver::index_of(int slot) const {
  const btRigidBody* body = m_tmpSolverBodyPool[slot].m_originalBody;
  return body == nullptr ? kNone : static_cast<std::uint32_t>(body->getUserIndex());
}

CoupledSolver::Row CoupledSolver::make_row(const ConstraintRow& what) const {
  Row row{what};
  double response = what.softness;
  const auto move = [&](std::uint32_t body, const math::Row& line, math::Row& moves) {
    if (body == kNone) return;
    moves = line;
    math::solve_factored(state_[body].factor, moves);
    response += math::dot6(line, moves);
  };
  move(what.a, what.first, row.moves_a), move(what.b, what.second, row.moves_b);
  row.per_impulse = response > 0 ? 1 / response : 0;
  return row;
}

// Bullet's own row, whose right side it has divided by the response of bodies without soil.
CoupledSolver::Row CoupledSolver::contact_row(const btSolverConstraint& c) const {
  ConstraintRow what{index_of(c.m_solverBodyIdA), index_of(c.m_solverBodyIdB)};
  what.first = math::row(from_bullet(c.m_contactNormal1), from_bullet(c.m_relpos1CrossNormal));
  what.second = math::row(from_bullet(c.m_contactNormal2), from_bullet(c.m_relpos2CrossNormal));
  const double scale = c.m_jacDiagABInv > 0 ? 1 / c.m_jacDiagABInv : 0;
  what.softness = c.m_cfm * scale;
  what.speed = c.m_rhs * scale;
  if (what.a != kNone) what.speed += math::dot6(what.first, state_[what.a].start);
  if (what.b != kNone) what.speed += math::dot6(what.second, state_[what.b].start);
  what.lower = c.m_lowerLimit, what.upper = c.m_upperLimit;
  what.impulse = c.m_appliedImpulse;
  return make_row(what);
}

void CoupledSolver::apply(const Row& row, double impulse) {
  if (row.what.a != kNone) math::add_scaled(state_[row.what.a].velocity, row.moves_a, impulse);
  if (row.what.b != kNone) math::add_scaled(state_[row.what.b].velocity, row.moves_b, impulse);
}

// One step of Gauss and Seidel; returns the change of speed along the row.
double CoupledSolver::relax(Row& row) {
  ConstraintRow& w = row.what;
  double missing = w.speed - w.softness * w.impulse;
  if (w.a != kNone) missing -= math::dot6(w.first, state_[w.a].velocity);
  if (w.b != kNone) missing -= math::dot6(w.second, state_[w.b].velocity);
  const double impulse = std::clamp(w.impulse + missing * row.per_impulse, w.lower, w.upper);
  const double change = impulse - w.impulse;
  if (change == 0) return 0;
  w.impulse = impulse;
  apply(row, change);
  return row.per_impulse > 0 ? change / row.per_impulse : 0;
}

// What joints and contacts gave in the last step is taken out of the velocities, and their rows put it back.
void CoupledSolver::start_bodies(btCollisionObject** bodies, int count) {
  for (int k = 0; k < count; ++k) {
    const int slot = bodies[k]->getCompanionId();
    if (slot < 0 || index_of(slot) == kNone) continue;
    const std::uint32_t i = index_of(slot);
    const btSolverBody& b = m_tmpSolverBodyPool[slot];
    BodyState& s = state_[i];
    s.slot = slot;
    s.start = math::row(from_bullet(b.m_linearVelocity + b.m_externalForceImpulse),
                        from_bullet(b.m_angularVelocity + b.m_externalTorqueImpulse));
    s.factor = resistance_[i].whole;
    math::factorize(s.factor);
    math::Row taken = resistance_[i].steady;
    math::solve_factored(s.factor, taken);
    s.velocity = s.start;
    math::add_scaled(s.velocity, taken, -1);
  }
}

void CoupledSolver::start_contacts() {
  contact_rows_.clear(), friction_rows_.clear(), joint_rows_.clear();
  for (int k = 0; k < m_tmpSolverContactConstraintPool.size(); ++k)
    contact_rows_.push_back(contact_row(m_tmpSolverContactConstraintPool[k]));
  for (int k = 0; k < m_tmpSolverContactFrictionConstraintPool.size(); ++k)
    friction_rows_.push_back(contact_row(m_tmpSolverContactFrictionConstraintPool[k]));
  for (const ConstraintRow& joint : joints_) joint_rows_.push_back(make_row(joint));
  for (std::vector<Row>* rows : {&contact_rows_, &friction_rows_, &joint_rows_})
    for (const Row& row : *rows) {
      apply(row, row.what.impulse);
      for (const std::uint32_t body : {row.what.a, row.what.b})
        if (body != kNone) state_[body].coupled = true;
    }
}

btScalar CoupledSolver::solveGroupCacheFriendlySetup(btCollisionObject** bodies, int count,
                                                     btPersistentManifold** manifolds, int manifold_count,
                                                     btTypedConstraint** constraints, int constraint_count,
                                                     const btContactSolverInfo& info, btIDebugDraw* draw) {
  const auto touching = touches_->recall(manifolds, manifold_count);
  const btScalar result = btSequentialImpulseConstraintSolver::solveGroupCacheFriendlySetup(
      bodies, count, touching.data(), static_cast<int>(touching.size()), constraints, constraint_count, info, draw);
  start_bodies(bodies, count);
  start_contacts();
  return result;
}

btScalar CoupledSolver::solveSingleIteration(int, btCollisionObject**, int, btPersistentManifold**, int,
                                             btTypedConstraint**, int, const btContactSolverInfo&, btIDebugDraw*) {
  double fastest = 0;
  for (Row& row : joint_rows_) fastest = std::max(fastest, std::abs(relax(row)));
  for (Row& row : contact_rows_) fastest = std::max(fastest, std::abs(relax(row)));
  for (std::size_t k = 0; k < friction_rows_.size(); ++k) {
    const btSolverConstraint& c = m_tmpSolverContactFrictionConstraintPool[static_cast<int>(k)];
    const double most =
        c.m_friction * std::max(0.0, contact_rows_[static_cast<std::size_t>(c.m_frictionIndex)].what.impulse);
    friction_rows_[k].what.lower = -most, friction_rows_[k].what.upper = most;
    fastest = std::max(fastest, std::abs(relax(friction_rows_[k])));
  }
  return fastest;
}

btScalar CoupledSolver::solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int count,
                                                      const btContactSolverInfo& info) {
  for (std::size_t i = 0; i < state_.size(); ++i) {
    BodyState& s = state_[i];
    if (s.slot < 0) continue;
    btSolverBody& b = m_tmpSolverBodyPool[s.slot];
    math::Row change = s.velocity;
    math::add_scaled(change, s.start, -1);
    // Without joints and contacts a body keeps its velocity to the last bit.
    if (!s.coupled && resistance_[i].steady == math::Row{}) change = {};
    b.m_deltaLinearVelocity = to_bullet(math::linear(change));
    b.m_deltaAngularVelocity = to_bullet(math::angular(change));
    if (!s.coupled) continue;
    s.impulse = math::times(resistance_[i].whole, change);
    math::add_scaled(s.impulse, resistance_[i].steady, 1);
  }
  for (std::size_t k = 0; k < contact_rows_.size(); ++k)
    m_tmpSolverContactConstraintPool[static_cast<int>(k)].m_appliedImpulse = contact_rows_[k].what.impulse;
  for (std::size_t k = 0; k < friction_rows_.size(); ++k)
    m_tmpSolverContactFrictionConstraintPool[static_cast<int>(k)].m_appliedImpulse = friction_rows_[k].what.impulse;
  for (std::size_t k = 0; k < joint_rows_.size(); ++k) joints_[k].impulse = joint_rows_[k].what.impulse;
  return btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyFinish(bodies, count, info);
}

}  // namespace divot::contact
