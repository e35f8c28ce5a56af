#pragma once

#include "contact/contact.h"

namespace divot::contact {

/// The body's velocities at the end of the step under gravity and the soil's answer, found implicitly, so that soil may
/// be as stiff as asphalt under a body as light as a feather. Changes body.velocity, body.angular_velocity, what
/// restitution is owed, and how each column ends the step (scratch.columns).
/// With the geometry frozen the balance is the minimum of a convex function, which Newton's method with a line search
/// finds; two or three passes let geometry and grip follow.
/// [O(passes x iterations x footings)]
/// Joints and other bodies are taken to give what they gave in the last step; `resistance` is what any other impulse
/// meets.
void meet_soil(state::Body& body, const Situation& s, Scratch::PerBody& scratch, Resistance& resistance);

/// How the columns end the step at the velocity that joints and other bodies left the body with; `before`: where it
/// was.
void answer_again(const state::Body& body, const Scratch::Pose& before, const Situation& s, Scratch::PerBody& scratch);

/// Where the body, now at the end of its step, has pressed the ground to: scratch.presses, ascending by vertex. Also
/// the body's sinkage, patch width and last contact.
void record_presses(state::Body& body, Scratch::PerBody& scratch);

}  // namespace divot::contact
