#pragma once

#include <btBulletDynamicsCommon.h>

#include <span>
#include <vector>

#include "contact/joint_rows.h"
#include "contact/resistance.h"
#include "contact/touches.h"
#include "math/six.h"

namespace divot::contact {

/// Bullet's solver of impulses, which finds what bodies do to each other, over soil: an impulse on a body that stands
/// in soil moves it against inertia and soil together, so that nothing is pushed through the ground it stands on.
/// Joints are solved with the contacts; both start from what they were in the last step. Their impulses come back in
/// their rows.
class CoupledSolver : public btSequentialImpulseConstraintSolver {
 public:
  /// For the next step. Body i has user index i; rows belong to joints; `touches` are those of the step before.
  void prepare(std::span<ConstraintRow> joints, std::span<const Resistance> bodies, Touches& touches);

  /// Impulse of joints and contacts on a body in the last step; 0 for those that had neither.
  const math::Row& impulse(std::size_t body) const { return state_[body].impulse; }
  /// Whether the last step changed the body's velocity.
  bool coupled(std::size_t body) const { return state_[body].coupled; }

 protected:
  btScalar solveGroupCacheFriendlySetup(btCollisionObject** bodies, int count, btPersistentManifold** manifolds,
                                        int manifold_count, btTypedConstraint** constraints, int constraint_count,
                                        const btContactSolverInfo& info, btIDebugDraw* draw) override;
  btScalar solveSingleIteration(int iteration, btCollisionObject** bodies, int count, btPersistentManifold** manifolds,
                                int manifold_count, btTypedConstraint** constraints, int constraint_count,
                                const btContactSolverInfo& info, btIDebugDraw* draw) override;
  btScalar solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int count,
                                         const btContactSolverInfo& info) override;

 private:
  struct BodyState {
    math::Row start{}, velocity{};  // as Bullet got it; now
    math::Matrix6 factor{};
    math::Row impulse{};
    bool coupled = false;
    int slot = -1;  // in Bullet's pool
  };
  struct Row {
    ConstraintRow what;
    math::Row moves_a{}, moves_b{};  // what a unit impulse changes
    double per_impulse = 0;          // inverse of the line's response and softness
  };

  std::uint32_t index_of(int slot) const;
  Row make_row(const ConstraintRow& what) const;
  Row contact_row(const btSolverConstraint& c) const;
  void apply(const Row& row, double impulse);
  double relax(Row& row);
  void start_bodies(btCollisionObject** bodies, int count);
  void start_contacts();

  Touches* touches_ = nullptr;
  std::span<ConstraintRow> joints_;
  std::span<const Resistance> resistance_;
  std::vector<BodyState> state_;
  std::vector<Row> joint_rows_, contact_rows_, friction_rows_;
};

}  // namespace divot::contact
