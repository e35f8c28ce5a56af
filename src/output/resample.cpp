#include "output/resample.h"

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

// Height at which a vertex started, m.
double start_height(const state::Surface& surface, const state::Soil& soil, std::uint32_t vertex) {
  const std::uint32_t column = surface.column[vertex];
  return column == kNone ? surface.position[vertex].z : soil.original[column].z;
}

}  // namespace

RasterView resample(const state::Surface& surface, const state::Soil& soil) {
  DIVOT_ASSERT(surface.raster.has_value());
  const state::Raster& grid = *surface.raster;
  const auto [columns, rows] = grid.layout;
  const std::size_t pixels = static_cast<std::size_t>(columns) * rows;
  RasterView out{.columns = columns,
                 .rows = rows,
                 .x0 = grid.x0,
                 .y0 = grid.y0 + grid.dy * (rows - 1),
                 .dx = grid.dx,
                 .dy = grid.dy,
                 .crs = grid.crs,
                 .heights = std::vector<float>(pixels),
                 .change = std::vector<float>(pixels),
                 .sinkage = std::vector<float>(pixels),
                 .holes = std::vector<std::uint8_t>(pixels)};
  const auto height = [&](std::uint32_t v) { return static_cast<double>(surface.position[v].z); };
  const auto sinkage = [&](std::uint32_t v) { return start_height(surface, soil, v) - height(v); };
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t vertex = grid.layout.vertex(column, row);
      const std::size_t pixel = static_cast<std::size_t>(rows - 1 - row) * columns + column;
      const Vec3& p = surface.position[vertex];
      const double x = grid.x0 + column * grid.dx - surface.origin.x;
      const double y = grid.y0 + row * grid.dy - surface.origin.y;
      // Most vertices never moved, and those keep their height to the bit.
      const bool at_node = p.x == static_cast<float>(x) && p.y == static_cast<float>(y);
      const auto place = at_node ? std::nullopt : place_at(surface, vertex, x, y);
      const double z = place ? place->mean(height) : height(vertex);
      out.heights[pixel] = static_cast<float>(z + surface.origin.z);
      // The vertex stood here at the start.
      out.change[pixel] = static_cast<float>(z - start_height(surface, soil, vertex));
      out.sinkage[pixel] = static_cast<float>(place ? place->mean(sinkage) : sinkage(vertex));
      out.holes[pixel] = surface.mesh.outgoing(vertex) == kNone;
    }
  }
  return out;
}

}  // namespace divot::output
