#include "output/resample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/assert.h"

namespace divot::output {
namespace {

// Twice the area of a triangle seen from above, > 0 when counter-clockwise; from the node, so that small offsets count.
double area2(const Vec3d& a, const Vec3d& b) { return a.x * b.y - a.y * b.x; }

// A place on the surface: the corners of a triangle and what each counts for.
struct Place {
  std::array<std::uint32_t, 3> vertex;
  std::array<double, 3> weight;  // sum 1

  std::uint32_t nearest() const {
    return vertex[static_cast<std::size_t>(std::ranges::max_element(weight) - weight.begin())];
  }
  template <class F>
  double mean(F value) const {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += weight[k] * value(vertex[k]);
    return sum;
  }
};

// The place at x, y (m, relative to the surface's origin), looked for from a vertex; nothing where there is none.
std::optional<Place> place_at(const state::Surface& surface, std::uint32_t from, double x, double y) {
  // A particle is at most a few cells away from its node; whoever walks longer goes in circles over a fold. Where cells
  // have been halved, there are more on the way.
  constexpr int kMostSteps = 64, kMostHalved = 4096;
  const geometry::HalfEdgeMesh& mesh = surface.mesh;
  const int most = surface.bisection.any() ? kMostHalved : kMostSteps;
  std::uint32_t h = mesh.outgoing(from);
  for (int step = 0; step < most && h != kNone; ++step) {
    const std::array<std::uint32_t, 3> edge{h, mesh.next(h), mesh.prev(h)};
    const std::array<std::uint32_t, 3> vertex{mesh.origin(edge[0]), mesh.origin(edge[1]), mesh.origin(edge[2])};
    std::array<Vec3d, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) corner[k] = to_double(surface.position[vertex[k]]) - Vec3d{x, y, 0};
    // Each edge's share of the area is the weight of the corner it does not touch.
    const std::array<double, 3> side{area2(corner[0], corner[1]), area2(corner[1], corner[2]),
                                     area2(corner[2], corner[0])};
    std::size_t worst = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (side[k] < side[worst]) worst = k;
    if (side[worst] < 0) {
      h = mesh.twin(edge[worst]);  // the node lies beyond this edge most of all
      continue;
    }
    const double sum = side[0] + side[1] + side[2];
    if (!(sum > 0)) return std::nullopt;
    return Place{vertex, {side[1] / sum, side[2] / sum, side[0] / sum}};
  }
  return std::nullopt;
}

// How many pixels there are from node to node, where they are at most `spacing` apart.
double parts(double node_spacing, double spacing) {
  // What the grid's is a multiple of is met in spite of rounding.
  return spacing > 0 ? std::clamp(std::ceil(node_spacing / spacing - 1e-6), 1.0, 1e9) : 1;
}

// What of the grid was at a place at the start, `x` and `y` in cells from the south-western node; nothing in a hole.
std::optional<Place> start_place(const state::Surface& surface, double x, double y) {
  const state::GridLayout& layout = surface.raster->layout;
  const auto column = std::min(static_cast<std::uint32_t>(x), layout.columns - 2);
  const auto row = std::min(static_cast<std::uint32_t>(y), layout.rows - 2);
  x -= column, y -= row;
  // Corners counter-clockwise from the south-west, and how far it is to the side from each to the next.
  const std::array<std::uint32_t, 4> corner{layout.vertex(column, row), layout.vertex(column + 1, row),
                                            layout.vertex(column + 1, row + 1), layout.vertex(column, row + 1)};
  const std::array<double, 4> side{y, 1 - x, 1 - y, x};
  const auto is_hole = [&](std::size_t k) { return surface.mesh.outgoing(corner[k]) == kNone; };
  // A triangle has all corners but one: the hole, else the one beyond the diagonal.
  const bool rises = (column + row) % 2 == 0;
  std::size_t without = rises ? (x > y ? 3 : 1) : (x + y > 1 ? 0 : 2);
  for (std::size_t k = 0; k < 4; ++k)
    if (is_hole(k)) without = k;
  const std::size_t a = (without + 1) % 4, b = (without + 2) % 4, c = (without + 3) % 4;
  const double beside_b = side[b] + side[a];
  if (is_hole(a) || is_hole(b) || is_hole(c) || beside_b > 1 + 1e-9) return std::nullopt;
  return Place{{corner[a], corner[b], corner[c]}, {side[b], 1 - beside_b, side[a]}};
}

// Height at which a vertex started, m.
double start_height(const state::Surface& surface, const state::Soil& soil, std::uint32_t vertex) {
  const std::uint32_t column = surface.column[vertex];
  return column == kNone ? surface.position[vertex].z : soil.original[column].z;
}

}  // namespace

std::array<std::uint64_t, 2> pixels_of(const state::Raster& grid, double spacing) {
  const auto along = [&](std::uint32_t nodes, double d) {
    return static_cast<std::uint64_t>((nodes - 1) * parts(d, spacing)) + 1;
  };
  return {along(grid.layout.columns, grid.dx), along(grid.layout.rows, grid.dy)};
}

RasterView resample(const state::Surface& surface, const state::Soil& soil, double spacing) {
  DIVOT_ASSERT(surface.raster.has_value());
  const state::Raster& grid = *surface.raster;
  const double across = parts(grid.dx, spacing), up = parts(grid.dy, spacing);
  const auto [columns, rows] = pixels_of(grid, spacing);
  const std::size_t pixels = columns * rows;
  RasterView out{.columns = static_cast<std::uint32_t>(columns),
                 .rows = static_cast<std::uint32_t>(rows),
                 .x0 = grid.x0,
                 .y0 = grid.y0 + grid.dy * (grid.layout.rows - 1),
                 .dx = grid.dx / across,
                 .dy = grid.dy / up,
                 .crs = grid.crs,
                 .file_crs = grid.file_crs,
                 .heights = std::vector<float>(pixels),
                 .change = std::vector<float>(pixels),
                 .sinkage = std::vector<float>(pixels),
                 .holes = std::vector<std::uint8_t>(pixels)};
  const auto height = [&](std::uint32_t v) { return static_cast<double>(surface.position[v].z); };
  const auto started = [&](std::uint32_t v) { return static_cast<double>(start_height(surface, soil, v)); };
  const auto sinkage = [&](std::uint32_t v) { return started(v) - height(v); };
  for (std::uint64_t row = 0; row < rows; ++row) {
    for (std::uint64_t column = 0; column < columns; ++column) {
      const std::size_t pixel = (rows - 1 - row) * columns + column;
      const double in_column = static_cast<double>(column) / across;  // in nodes
      const double in_row = static_cast<double>(row) / up;
      const double x = grid.x0 + in_column * grid.dx - surface.origin.x;
      const double y = grid.y0 + in_row * grid.dy - surface.origin.y;
      const bool is_node = in_column == std::floor(in_column) && in_row == std::floor(in_row);
      std::optional<Place> start, now;
      if (is_node) {
        const std::uint32_t v =
            grid.layout.vertex(static_cast<std::uint32_t>(in_column), static_cast<std::uint32_t>(in_row));
        if (surface.mesh.outgoing(v) != kNone) start = Place{{v, v, v}, {1, 0, 0}};
      } else {
        start = start_place(surface, in_column, in_row);
      }
      out.holes[pixel] = !start;
      if (!start) continue;
      // Most vertices never moved, and those keep their height to the bit.
      const std::uint32_t from = start->nearest();
      const Vec3& p = surface.position[from];
      const bool at_rest = is_node && p.x == static_cast<float>(x) && p.y == static_cast<float>(y);
      if (!at_rest) now = place_at(surface, from, x, y);
      if (!now) now = start;
      const double z = now->mean(height);
      out.heights[pixel] = static_cast<float>(z + surface.origin.z);
      out.change[pixel] = static_cast<float>(z - start->mean(started));
      out.sinkage[pixel] = static_cast<float>(now->mean(sinkage));
    }
  }
  return out;
}

}  // namespace divot::output
