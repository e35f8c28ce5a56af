#pragma once

#include <span>

#include "contact/contact.h"

namespace divot::contact {

/// Takes from the footings what shear displacement they remember beyond that of the rim which now turns over them.
/// Soil stays where it is while a rim goes round: under a wheel that slips, a column is sheared for longer than any
/// point of the rim has been in the ground. Both slide on each other, so that j is the lesser of the two; the rim's is
/// that of [Wong & Reece 1967], its slip over its way through the ground since it came in at the front. [O(footings)]
void limit_to_rim(const Row& v, double dt, std::span<Footing> footings, Columns& columns);

}  // namespace divot::contact
