#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "state/surface.h"

namespace divot::terrain {

/// Makes holes of vertices where the surface would hang together by a single point (two holes diagonal or opposite to
/// each other), which is no surface to walk on. `holes`: [vertex] 1 where there is no data. [O(vertices)]
void close_pinches(const state::GridLayout& layout, std::vector<std::uint8_t>& holes);

/// The triangles over the cells whose corners have data, [3 * face] vertices, counter-clockwise from above, tile by
/// tile like the vertices. A cell with one hole keeps the triangle of the other three corners.
///
/// Diagonals alternate like the colours of a chessboard. With all of them in one direction, ridges along it come out
/// smooth and those across it as saw teeth, and a crater gets two ears; alternating, every second vertex has eight
/// neighbours and the others four, and the mesh with an even number of cells is its own mirror image in x and y.
/// Cutting each cell along its flatter diagonal was left out: the pattern would depend on the last bit of the heights
/// and go stale with the first crater.
std::vector<std::uint32_t> triangulate(const state::GridLayout& layout, std::span<const std::uint8_t> holes);

}  // namespace divot::terrain
