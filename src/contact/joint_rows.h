#pragma once

#include <span>
#include <vector>

#include "math/six.h"
#include "state/bodies.h"
#include "state/joints.h"

namespace divot::contact {

/// One thing that an impulse along one line between two bodies brings about: first . v_first + second . v_second +
/// softness x impulse = speed, the impulse between its bounds.
struct ConstraintRow {
  std::uint32_t a = kNone, b = kNone;  // bodies; kNone: the world
  math::Row first{}, second{};
  double speed = 0;     // m/s or rad/s
  double softness = 0;  // per N s or N m s
  double lower = 0, upper = 0;
  double impulse = 0;  // N s or N m s
};

/// How a joint keeps a body to its other body while the soil's answer is found: a stiff pull of the speed along `line`
/// towards `speed`.
struct Guide {
  math::Row line{};
  double speed = 0;
};

/// The guides of a body by the rows that hold it hard, the other bodies moving on as they do.
void find_guides(std::uint32_t body, std::span<const ConstraintRow> rows, std::span<const state::Body> bodies,
                 std::vector<Guide>& guides);

/// Appends the rows of a joint for a step of dt from `time` on, each with the impulse of the last step, and brings its
/// position and speed up to date. Springs and stops are solved implicitly: stable at any stiffness.
void append_rows(state::HeldJoint& joint, std::span<const state::Body> bodies, double time, double dt,
                 std::vector<ConstraintRow>& rows);

/// Takes the impulses back that were found for the joint's rows, `rows` being its own.
void keep_impulses(state::HeldJoint& joint, std::span<const ConstraintRow> rows, double dt);

}  // namespace divot::contact
