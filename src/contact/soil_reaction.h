#pragma once

#include "contact/contact.h"

namespace divot::contact {

/// The body's velocities at the end of the step under gravity and the soil's answer, found implicitly, so that soil may
/// be as stiff as asphalt under a body as light as a feather. Changes body.velocity, body.angular_velocity, what
/// restitution is owed, and each footing's load and answer.
/// With the geometry frozen the balance is the minimum of a convex function, which Newton's method with a line search
/// finds; three passes let geometry and grip follow. [O(passes x iterations x footings)]
void meet_soil(state::Body& body, std::vector<Footing>& footings, const Situation& s, std::vector<Contact>& contacts);

/// Where the body, now at the end of its step, has pressed the ground to: `presses`, ascending by vertex. Also the
/// body's sinkage, patch width and last contact.
void record_presses(state::Body& body, const std::vector<Footing>& footings, const std::vector<Contact>& contacts,
                    std::vector<Press>& presses);

}  // namespace divot::contact
