#pragma once

#include "contact/contact.h"

namespace divot::contact {

/// What body and soil may travel in a step, m.
double step_travel(const state::Body& body, const Situation& s);

/// How far a step reaches, m: step_travel(), and the neighbour that the body's lowest point belongs to.
double step_reach(const state::Body& body, const Situation& s);

/// Brings body.near up to date: every vertex that the body can touch before body.near_left is used up. scratch.start
/// must be the body where it is. With the adaptive policy a body that touched before is followed by a walk over the
/// half-edges from its last contact, which needs no hierarchy; others ask the BVH. Both find the same vertices.
void find_near(state::Body& body, const Situation& s, Scratch::PerBody& scratch);

}  // namespace divot::contact
