#pragma once

#include "contact/contact.h"

namespace divot::contact {

/// scratch.columns of scratch.footings, without geometry. Load and held force stay as they are: nothing in a new
/// column. [O(footings)]
void fill_columns(const state::Body& body, const Situation& s, Scratch::PerBody& scratch);

/// Freezes the geometry of every column that the body is over when it moves with `v` from `start` for this step, and
/// the grip at the load known. [O(footings)]
void freeze_geometry(const state::Body& body, const Scratch::Pose& start, const Row& v, const Situation& s,
                     Scratch::PerBody& scratch);

}  // namespace divot::contact
