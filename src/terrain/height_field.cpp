#include "terrain/height_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "terrain/lattice.h"

namespace divot::terrain {
namespace {

// What a vertex takes: its own columns, two faces of three corners and, with four boxes of six floats to 32 faces, 7 of
// the hierarchy.
constexpr std::uint64_t kBytesPerVertex = sizeof(Vec3) + sizeof(std::uint8_t) + sizeof(std::uint32_t) +  //
                                          6 * sizeof(std::uint32_t) + 7;
// Six half-edges a vertex have to be numbered in 32 bits, kNone left out.
constexpr std::uint64_t kMostVertices = (kNone - 1) / 6;

std::vector<std::uint8_t> holes_by_vertex(const HeightField& field) {
  const state::GridLayout& layout = field.raster.layout;
  std::vector<std::uint8_t> holes(field.height.size());
  for (std::uint32_t row = 0; row < layout.rows; ++row)
    for (std::uint32_t column = 0; column < layout.columns; ++column)
      holes[layout.vertex(column, row)] = std::isnan(field.at(column, row));
  return holes;
}

float mean_height(const std::vector<float>& height) {
  double sum = 0;
  std::uint64_t count = 0;
  for (const float z : height)
    if (!std::isnan(z)) sum += z, ++count;
  return static_cast<float>(sum / static_cast<double>(count));
}

std::vector<Vec3> positions(const HeightField& field, const Vec3d& origin) {
  const state::Raster& raster = field.raster;
  // A hole stands at the mean height: nothing touches it, but whoever loops over all vertices meets finite numbers.
  const float mean = mean_height(field.height);
  std::vector<Vec3> out(field.height.size());
  for (std::uint32_t row = 0; row < raster.layout.rows; ++row) {
    for (std::uint32_t column = 0; column < raster.layout.columns; ++column) {
      const float z = std::isnan(field.at(column, row)) ? mean : field.at(column, row);
      const Vec3d p{raster.x0 + column * raster.dx, raster.y0 + row * raster.dy, z};
      out[raster.layout.vertex(column, row)] = to_float(p - origin);
    }
  }
  return out;
}

}  // namespace

Result<void> check_size(std::uint64_t columns, std::uint64_t rows, std::uint64_t max_vertices, Error where) {
  if (columns < 2 || rows < 2) {
    where.problem = fmt::format("a terrain of {} x {} vertices has no cell", columns, rows);
    where.expected = "expected at least 2 x 2";
    return fail(std::move(where));
  }
  const std::uint64_t most = std::min(max_vertices, kMostVertices);
  if (columns <= most / rows) return {};
  const double count = static_cast<double>(columns) * static_cast<double>(rows);
  where.problem = fmt::format("{} x {} = {:.0f} vertices are more than the limit of {} and would take about {:.1f} GB",
                              columns, rows, count, most, count * static_cast<double>(kBytesPerVertex) * 1e-9);
  where.expected = most < kMostVertices ? "expected a smaller terrain or a higher `terrain.max_vertices`"
                                        : "expected a smaller terrain: more cannot be numbered";
  return fail(std::move(where));
}

Result<state::Surface> build_surface(HeightField field, const Vec3d& origin, Error where) {
  std::vector<std::uint8_t> holes = holes_by_vertex(field);
  close_pinches(field.raster.layout, holes);
  std::vector<std::uint32_t> triangles = triangulate(field.raster.layout, holes);
  if (triangles.empty()) {
    where.problem = "no three neighbouring vertices have a height";
    where.expected = "expected a terrain that is not all nodata";
    return fail(std::move(where));
  }

  state::Surface surface;
  const auto count = static_cast<std::uint32_t>(field.height.size());
  if (triangles.size() == 6 * std::size_t{field.raster.layout.cell_count()}) {
    surface.mesh = geometry::HalfEdgeMesh::of_grid(field.raster.layout, std::move(triangles));
  } else {
    auto mesh = geometry::HalfEdgeMesh::build(count, std::move(triangles));
    if (!mesh) return tl::unexpected(mesh.error());
    surface.mesh = std::move(*mesh);
  }
  surface.origin = origin;
  surface.position = positions(field, origin);
  surface.material.assign(count, 0);
  surface.column.assign(count, kNone);
  surface.spacing = static_cast<float>((field.raster.dx + field.raster.dy) / 2);
  surface.raster = std::move(field.raster);
  return surface;
}

}  // namespace divot::terrain
