#include "world/state.h"

namespace divot {

StepReport World::step() {
  Impl& w = *impl_;
  StepReport report;
  bool particles_changed = w.refine_ground(report);
  w.set_off_bombs();
  w.move_bodies(report);
  particles_changed |= w.wake_and_sleep();
  w.move_particles(particles_changed, report);
  w.settle_ground(particles_changed);
  w.refit_tree();
  ++w.step_count;
  return report;
}

}  // namespace divot
