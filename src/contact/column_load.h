#pragma once

#include "contact/contact.h"
#include "laws/bekker.h"

namespace divot::contact {

/// Freezes the geometry of every column that the body is over when it moves with `v` from `start` for this step.
/// [O(footings)]
void freeze_geometry(const state::Body& body, const Scratch::Pose& start, const Row& v, const Situation& s,
                     Scratch::PerBody& scratch);

/// A column's vertical push, N, >= 0, and how fast it falls with the speed at which the underside rises and with that
/// at which the body lifts off the ground, N s/m.
struct Push {
  double force = 0, per_rising = 0, per_lifting = 0;
};
Push push_of(const state::Body& body, const Footing& f, const Contact& c, const Row& v, const Situation& s);

/// A column's shear force along both tangents, against the slip, N; its slope, N/m, along the shear displacement and
/// across it.
struct Shear {
  double force[2] = {0, 0};
  double along[2] = {1, 0};  ///< unit, direction of the shear displacement
  double tangent = 0, secant = 0;
};
Shear shear_of(const laws::Medium& medium, const Footing& f, const Contact& c, const std::array<double, 2>& slip,
               double dt);

/// Largest shear force at the footing's load, N: the soil's strength or the body's own friction.
double grip_of(const state::Body& body, const Footing& f, const Contact& c, const Situation& s);

/// How the column ends the step.
Answer answer_of(const state::Body& body, const Footing& f, const Contact& c, const Row& v, const Situation& s);

}  // namespace divot::contact
