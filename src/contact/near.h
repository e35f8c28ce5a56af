#pragma once

#include "contact/contact.h"

namespace divot::contact {

/// Height of the body's underside over x, y, relative to the origin, m, and the outward unit normal there.
struct Underside {
  bool below = false;  ///< the body is over this point at all
  double height = 0;
  Vec3d normal;
};
Underside underside(const state::Body& body, const Vec3d& position, double x, double y);

/// Could the body touch a vertex at `p` if both came nearer by `reach`, m?
bool within_reach(const state::Body& body, const Vec3& p, double reach);

/// How far a step reaches, m: what body and soil may travel in it, and the neighbour that the body's lowest point
/// belongs to.
double step_reach(const state::Body& body, const Situation& s);

/// Brings body.near up to date: every vertex that the body can touch before body.near_left is used up.
/// With the adaptive policy a body that touched before is followed by a walk over the half-edges from its last contact,
/// which needs no hierarchy; others ask the BVH. Both find the same vertices.
void find_near(state::Body& body, const Situation& s, Scratch::PerBody& scratch);

}  // namespace divot::contact
