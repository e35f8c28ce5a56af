#include "terrain/grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "terrain/height_field.h"

namespace divot::terrain {
namespace {

Error at_key(const char* key) {
  Error error;
  error.key = key;
  return error;
}

// Heights from the caller's function; NaN would be taken for a hole, so what is not finite is refused here.
Result<void> fill(const GridTerrain& grid, HeightField& field) {
  const state::Raster& raster = field.raster;
  for (std::uint32_t row = 0; row < raster.layout.rows; ++row) {
    for (std::uint32_t column = 0; column < raster.layout.columns; ++column) {
      const double x = raster.x0 + column * raster.dx, y = raster.y0 + row * raster.dy;
      const auto z = static_cast<float>(grid.height(x, y));
      if (!std::isfinite(z)) {
        Error error = at_key("terrain.grid");
        error.problem = fmt::format("the height at ({}, {}) is not finite", x, y);
        error.expected = "expected a number of metres";
        return fail(std::move(error));
      }
      field.height[static_cast<std::size_t>(row) * raster.layout.columns + column] = z;
    }
  }
  return {};
}

// The function is not ours: what it throws ends here, as an error.
Result<void> fill_guarded(const GridTerrain& grid, HeightField& field) {
  try {
    return fill(grid, field);
  } catch (const std::exception& e) {
    Error error = at_key("terrain.grid");
    error.problem = fmt::format("the height function failed: {}", e.what());
    return fail(std::move(error));
  }
}

}  // namespace

Result<state::Surface> load_grid(const GridTerrain& grid, std::uint64_t max_vertices) {
  const auto columns = static_cast<std::uint32_t>(std::max(grid.columns, 0));
  const auto rows = static_cast<std::uint32_t>(std::max(grid.rows, 0));
  if (auto ok = check_size(columns, rows, max_vertices, at_key("terrain.grid")); !ok) return tl::unexpected(ok.error());
  if (!(grid.spacing > 0) || !std::isfinite(grid.spacing)) {
    Error error = at_key("terrain.grid.spacing");
    error.problem = fmt::format("{} is no distance", grid.spacing);
    error.expected = "expected metres, above 0";
    return fail(std::move(error));
  }

  HeightField field;
  field.raster = {.layout = {columns, rows},
                  .x0 = -0.5 * grid.spacing * (columns - 1),
                  .y0 = -0.5 * grid.spacing * (rows - 1),
                  .dx = grid.spacing,
                  .dy = grid.spacing,
                  .crs = {}};
  field.height.assign(static_cast<std::size_t>(columns) * rows, 0.0f);
  if (grid.height) {
    if (auto ok = fill_guarded(grid, field); !ok) return tl::unexpected(ok.error());
  }
  return build_surface(std::move(field), Vec3d{}, at_key("terrain.grid"));
}

}  // namespace divot::terrain
