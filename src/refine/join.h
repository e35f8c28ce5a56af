#pragma once

#include "refine/halve.h"

namespace divot::refine {

/// How far the surface would move, m, if an added vertex went; infinite where it has to stay: triangles round it are
/// halved further, it or a corner round it is awake, or the soil there is another one than at the ends of its edge by
/// more than `tolerance`, m. [O(valence)]
double bulge_at(const Ground& ground, std::uint32_t vertex, float tolerance);

/// How much the ground round an added vertex was deformed: the range of what it and its corners sank, m. [O(valence)]
double relief_at(const Ground& ground, std::uint32_t vertex);

/// Takes a vertex out that halve_edge made, where Bisection::can_merge() holds and nothing is awake. What is in its
/// books goes in equal parts to the ends of its edge, and so does the volume that the surface loses. [O(valence)]
void join_edge(Ground& ground, std::uint32_t vertex);

}  // namespace divot::refine
