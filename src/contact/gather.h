#pragma once

#include "contact/contact.h"

namespace divot::contact {

/// Fills scratch.footings with the columns within this step's reach of the body, ascending by vertex. scratch.presses:
/// what it pressed in the last step; scratch.start: the body where it is.
void gather(const state::Body& body, const Situation& s, Scratch::PerBody& scratch);

}  // namespace divot::contact
