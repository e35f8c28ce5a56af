#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "divot/ids.h"

namespace divot::geometry {

/// How a regular grid's vertices and triangles are numbered: tile by tile, so that near neighbours are near in memory
/// and a tile can later be loaded by itself. Row 0 is the southernmost, column 0 the westernmost.
///
/// Cell (column, row) lies north-east of that vertex. Its two triangles are on both sides of a diagonal, which rises to
/// the north-east where column + row is even, (SW, SE, NE) (SW, NE, NW), and else falls, (SE, NE, NW) (SE, NW, SW).
/// What meets what follows from that, where no cell is missing: twin(), outgoing().
struct GridLayout {
  static constexpr std::uint32_t kTile = 32;
  std::uint32_t columns = 0, rows = 0;

  struct Node {
    std::uint32_t column = 0, row = 0;
    bool even() const { return (column + row) % 2 == 0; }
  };

  /// Vertex of a column and row. [O(1)]
  std::uint32_t vertex(std::uint32_t column, std::uint32_t row) const { return index({column, row}, columns, rows); }
  /// Column and row of a vertex. [O(1)]
  Node node(std::uint32_t vertex) const { return place(vertex, columns, rows); }
  /// Which cell, of those of a grid without holes, is the one of a column and row. [O(1)]
  std::uint32_t cell(std::uint32_t column, std::uint32_t row) const {
    return index({column, row}, columns - 1, rows - 1);
  }
  std::uint32_t cell_count() const { return (columns - 1) * (rows - 1); }

  /// HalfEdgeMesh::twin without holes. [O(1)]
  std::uint32_t twin(std::uint32_t half_edge) const {
    // For each of a cell's six half-edges: which way the twin lies, and which of the six it is there.
    enum Way : std::uint8_t { here, south, east, north, west };
    struct Across {
      Way way;
      std::uint8_t k;
    };
    static constexpr std::array<std::array<Across, 6>, 2> kAcross{
        {{{{east, 5}, {north, 0}, {here, 3}, {here, 2}, {west, 1}, {south, 4}}},
         {{{south, 1}, {east, 4}, {here, 3}, {here, 2}, {north, 5}, {west, 0}}}}};
    const Node at = place(half_edge / 6, columns - 1, rows - 1);
    const Across across = kAcross[at.even()][half_edge % 6];
    switch (across.way) {
      case here:
        return half_edge / 6 * 6 + across.k;
      case south:
        return at.row == 0 ? kNone : 6 * cell(at.column, at.row - 1) + across.k;
      case east:
        return at.column + 2 == columns ? kNone : 6 * cell(at.column + 1, at.row) + across.k;
      case north:
        return at.row + 2 == rows ? kNone : 6 * cell(at.column, at.row + 1) + across.k;
      case west:
        return at.column == 0 ? kNone : 6 * cell(at.column - 1, at.row) + across.k;
    }
    return kNone;
  }

  bool is_border(const Node& at) const {
    return at.column == 0 || at.row == 0 || at.column + 1 == columns || at.row + 1 == rows;
  }

  /// HalfEdgeMesh::outgoing without holes. [O(1)]
  std::uint32_t outgoing(std::uint32_t vertex) const {
    const Node at = node(vertex);
    const bool even = at.even();
    if (at.row == 0 && at.column + 1 < columns) return 6 * cell(at.column, 0) + (even ? 0 : 5);
    if (at.column + 1 == columns && at.row + 1 < rows) return 6 * cell(at.column - 1, at.row) + (even ? 0 : 1);
    if (at.row + 1 == rows && at.column > 0) return 6 * cell(at.column - 1, at.row - 1) + (even ? 4 : 1);
    if (at.column == 0) return 6 * cell(0, at.row - 1) + (even ? 4 : 5);
    return 6 * cell(at.column - 1, at.row - 1) + (even ? 2 : 1);
  }

  /// Half-edges in HalfEdgeMesh::for_each_outgoing's order.
  struct Fan {
    std::array<std::uint32_t, 8> half_edge;
    std::uint32_t count = 0;
  };
  /// Those from a node that is not at the border, where all four cells are there. [O(1)]
  Fan fan(const Node& at) const {
    const std::uint32_t sw = 6 * cell(at.column - 1, at.row - 1);
    std::uint32_t se = sw + 6, nw = sw + 6 * std::min(kTile, columns - 1 - at.column / kTile * kTile), ne = nw + 6;
    if (at.column % kTile == 0 || at.row % kTile == 0) {  // they lie in several tiles
      se = 6 * cell(at.column, at.row - 1);
      ne = 6 * cell(at.column, at.row);
      nw = 6 * cell(at.column - 1, at.row);
    }
    if (at.even()) return {{sw + 2, se + 4, se + 2, ne, ne + 3, nw, nw + 3, sw + 4}, 8};
    return {{sw + 1, se + 5, ne + 5, nw + 1}, 4};
  }

 private:
  // Of so many across and up, tile by tile.
  static std::uint32_t index(const Node& at, std::uint32_t across, std::uint32_t up) {
    const std::uint32_t band = at.row / kTile, tile = at.column / kTile;
    const std::uint32_t height = std::min(kTile, up - band * kTile), width = std::min(kTile, across - tile * kTile);
    return band * kTile * across + tile * kTile * height + (at.row - band * kTile) * width + (at.column - tile * kTile);
  }
  static Node place(std::uint32_t index, std::uint32_t across, std::uint32_t up) {
    const std::uint32_t band = index / (kTile * across), in_band = index - band * kTile * across;
    const std::uint32_t height = std::min(kTile, up - band * kTile);
    const std::uint32_t tile = height == kTile ? in_band / (kTile * kTile) : in_band / (kTile * height);
    const std::uint32_t width = std::min(kTile, across - tile * kTile), in_tile = in_band - tile * kTile * height;
    // Nearly all tiles are whole, and need no division.
    const std::uint32_t row = width == kTile ? in_tile / kTile : in_tile / width;
    return {tile * kTile + in_tile - row * width, band * kTile + row};
  }
};

}  // namespace divot::geometry
