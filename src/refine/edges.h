#pragma once

#include "geometry/solid.h"
#include "laws/medium.h"
#include "math/quat.h"

namespace divot::refine {

/// How near the ground under a body should come to it between two vertices.
struct Accuracy {
  double tolerance = 1e-3;  ///< m
  double error = 0.04;      ///< or this share of how deep the body sinks
};

/// Longest edge, m, that shows where a body touches. Under what is round an edge h is a chord, which leaves h^2 / 8 R
/// between ground and body: no more than `accuracy` says of the sinkage at which Bekker's pressure carries `load`, N.
/// A quarter of the width that is pressed at most, be it a wheel's or a plate's, and of a ball's radius.
double contact_edge(const geometry::Solid& solid, const Quat& orientation, double load, const laws::Medium& medium,
                    const Accuracy& accuracy);

/// Longest edge, m, that shows a crater by turning no further than `turn`, rad, from one triangle to the next. `radius`
/// and `depth` in m.
double crater_edge(double radius, double depth, double turn);

}  // namespace divot::refine
