#include "terrain/lattice.h"

#include <algorithm>
#include <array>
#include <utility>

namespace divot::terrain {
namespace {

using Node = std::pair<std::uint32_t, std::uint32_t>;  // column, row

// The eight around a node, counter-clockwise from the east. The even ones share an edge of the grid with it.
constexpr std::array<std::pair<int, int>, 8> kAround{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

// Which of the eight have data. Beyond the border there is none.
std::array<bool, 8> data_around(const state::GridLayout& layout, const std::vector<std::uint8_t>& holes, Node node) {
  std::array<bool, 8> out{};
  for (std::size_t k = 0; k < 8; ++k) {
    // Below 0 wraps round to more than any grid has.
    const std::uint32_t column = node.first + static_cast<std::uint32_t>(kAround[k].first);
    const std::uint32_t row = node.second + static_cast<std::uint32_t>(kAround[k].second);
    out[k] = column < layout.columns && row < layout.rows && !holes[layout.vertex(column, row)];
  }
  return out;
}

// Fans of triangles round a node with data: one fan starts at each edge that has a triangle on its left only.
// A cell has a triangle at the node when two of its other three corners have data.
int fan_count(const std::array<bool, 8>& data) {
  int starts = 0, cells = 0;
  for (std::size_t k = 0; k < 8; k += 2) {
    const bool edge = data[k];
    const bool left = edge + data[k + 1] + data[(k + 2) % 8] >= 2;
    const bool right = edge + data[(k + 7) % 8] + data[(k + 6) % 8] >= 2;
    cells += left;
    starts += left && !(edge && right);
  }
  return starts == 0 && cells > 0 ? 1 : starts;
}

// Calls `f(column, row)` for each cell, tile by tile; a cell is named after its south-western corner.
template <class F>
void for_each_cell(const state::GridLayout& layout, F&& f) {
  constexpr std::uint32_t kTile = state::GridLayout::kTile;
  const std::uint32_t columns = layout.columns - 1, rows = layout.rows - 1;
  for (std::uint32_t row0 = 0; row0 < rows; row0 += kTile)
    for (std::uint32_t column0 = 0; column0 < columns; column0 += kTile)
      for (std::uint32_t row = row0; row < std::min(rows, row0 + kTile); ++row)
        for (std::uint32_t column = column0; column < std::min(columns, column0 + kTile); ++column) f(column, row);
}

// Two triangles, or one beside a hole. Corners are counter-clockwise from the south-west.
void append_cell(const std::array<std::uint32_t, 4>& corner, std::span<const std::uint8_t> holes, bool rising,
                 std::vector<std::uint32_t>& out) {
  int hole_count = 0, hole = 0;
  for (int k = 0; k < 4; ++k)
    if (holes[corner[k]]) ++hole_count, hole = k;
  if (hole_count > 1) return;
  if (hole_count == 1) {
    for (int k = 1; k < 4; ++k) out.push_back(corner[(hole + k) % 4]);
    return;
  }
  // The diagonal starts at the south-west when it rises to the north-east, else at the south-east.
  const int s = rising ? 0 : 1;
  for (const int k : {s, s + 1, s + 2, s, s + 2, s + 3}) out.push_back(corner[k % 4]);
}

}  // namespace

void close_pinches(const state::GridLayout& layout, std::vector<std::uint8_t>& holes) {
  // A new hole can pinch its neighbours, so they are looked at again until nothing is left to look at.
  std::vector<Node> queue;
  const auto look_around = [&](Node node) {
    for (const auto& [dx, dy] : kAround) {
      const Node near{node.first + static_cast<std::uint32_t>(dx), node.second + static_cast<std::uint32_t>(dy)};
      if (near.first < layout.columns && near.second < layout.rows) queue.push_back(near);
    }
  };
  for (std::uint32_t row = 0; row < layout.rows; ++row)
    for (std::uint32_t column = 0; column < layout.columns; ++column) {
      if (holes[layout.vertex(column, row)]) look_around({column, row});
      while (!queue.empty()) {
        const Node node = queue.back();
        queue.pop_back();
        std::uint8_t& hole = holes[layout.vertex(node.first, node.second)];
        if (hole || fan_count(data_around(layout, holes, node)) <= 1) continue;
        hole = 1;
        look_around(node);
      }
    }
}

std::vector<std::uint32_t> triangulate(const state::GridLayout& layout, std::span<const std::uint8_t> holes) {
  std::vector<std::uint32_t> out;
  out.reserve(std::size_t{6} * (layout.columns - 1) * (layout.rows - 1));
  for_each_cell(layout, [&](std::uint32_t column, std::uint32_t row) {
    const std::array<std::uint32_t, 4> corner{layout.vertex(column, row), layout.vertex(column + 1, row),
                                              layout.vertex(column + 1, row + 1), layout.vertex(column, row + 1)};
    append_cell(corner, holes, (column + row) % 2 == 0, out);
  });
  return out;
}

}  // namespace divot::terrain
