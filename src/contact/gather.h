#pragma once

#include "contact/contact.h"

namespace divot::contact {

/// Fills `footings` with the columns within this step's reach of the body, ascending by vertex. `last`: what it pressed
/// in the last step.
void gather(const state::Body& body, const Situation& s, const std::vector<Press>& last,
            std::vector<Footing>& footings);

}  // namespace divot::contact
