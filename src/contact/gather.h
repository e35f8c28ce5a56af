#pragma once

#include "contact/contact.h"

namespace divot::contact {

/// Fills `ground` with what lies within this step's reach of the body, from the surface where it was never touched, from soil and
/// particles where it was.
void gather(const state::Body& body, const Situation& s, Ground& ground);

}  // namespace divot::contact
