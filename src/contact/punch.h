#pragma once

#include "contact/contact.h"

namespace divot::contact {

/// Appends to `broken` the vertices whose crust the bodies have punched through in this step: where the mean pressure
/// of all columns of one crust under a body is more than its rim holds. Call it after carry(). [O(presses)]
void find_punched(const Scratch& scratch, const state::Surface& surface, const state::Soil& soil,
                  std::span<const laws::Medium> media, std::vector<std::uint32_t>& broken);

}  // namespace divot::contact
