#pragma once

#include "contact/contact.h"

namespace divot::contact {

/// The body's velocities at the end of the step under gravity and the soil's answer, found implicitly (Newton's method on the six
/// momentum balances), so that soil may be as stiff as asphalt under a body as light as a feather. Changes body.velocity and
/// body.angular_velocity only. [O(iterations x vertices near)]
void meet_soil(state::Body& body, const Ground& ground, const Situation& s);

/// Where the body, now at the end of its step, has pressed the ground to: `presses`, ascending by vertex. Also the body's sinkage,
/// patch width and last contact.
void record_presses(state::Body& body, const Ground& ground, const Situation& s, std::vector<Press>& presses);

}  // namespace divot::contact
