#include "refine/join.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "state/region.h"

namespace divot::refine {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

struct Memory {
  float plastic = 0, loose = 0;
};

Memory memory_at(const Ground& ground, std::uint32_t vertex) {
  const std::uint32_t column = ground.surface.column[vertex];
  return column == kNone ? Memory{} : Memory{ground.soil.plastic[column], ground.soil.loose[column]};
}

bool is_particle(const Ground& ground, std::uint32_t vertex) {
  const std::uint32_t column = ground.surface.column[vertex];
  return column != kNone && ground.soil.particle[column] != kNone;
}

// Height over the place of `p` of the plane through a triangle; nothing where p lies outside of it.
double height_in(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& p) {
  const auto side = [&](const Vec3d& u, const Vec3d& v) {
    return (v.x - u.x) * (p.y - u.y) - (v.y - u.y) * (p.x - u.x);
  };
  const double at_a = side(b, c), at_b = side(c, a), at_c = side(a, b), all = at_a + at_b + at_c;
  const double least = -1e-3 * all;
  if (!(all > 0) || at_a < least || at_b < least || at_c < least) return std::numeric_limits<double>::quiet_NaN();
  return (at_a * a.z + at_b * b.z + at_c * c.z) / all;
}

void drop(std::uint32_t column, std::vector<std::uint32_t>& columns,
          std::initializer_list<std::vector<float>*> numbers) {
  const auto at = std::find(columns.begin(), columns.end(), column);
  if (at == columns.end()) return;
  const auto place = at - columns.begin();
  for (std::vector<float>* list : numbers) list->erase(list->begin() + place);
  columns.erase(at);
}

}  // namespace

double bulge_at(const Ground& ground, std::uint32_t vertex, float tolerance) {
  const state::Surface& surface = ground.surface;
  const geometry::HalfEdgeMesh& mesh = surface.mesh;
  if (!surface.bisection.can_merge(mesh, vertex) || is_particle(ground, vertex)) return kNever;
  const auto parents = surface.bisection.parents(vertex);
  const std::uint32_t a = parents[0], b = parents[1];
  const std::uint8_t material = surface.material[vertex];
  if (surface.material[a] != material || surface.material[b] != material) return kNever;
  const Memory own = memory_at(ground, vertex), first = memory_at(ground, a), second = memory_at(ground, b);
  if (std::abs(own.plastic - 0.5f * (first.plastic + second.plastic)) > tolerance) return kNever;
  if (std::abs(own.loose - 0.5f * (first.loose + second.loose)) > tolerance) return kNever;

  const auto at = [&](std::uint32_t v) { return to_double(surface.position[v]); };
  bool awake = false;
  double height = std::numeric_limits<double>::quiet_NaN();
  mesh.for_each_neighbour(vertex, [&](std::uint32_t u) {
    awake |= is_particle(ground, u);
    if (u == a || u == b) return;
    for (const double z : {height_in(at(a), at(b), at(u), at(vertex)), height_in(at(b), at(a), at(u), at(vertex))})
      if (!std::isnan(z)) height = z;
  });
  // A vertex of the border stays on it.
  if (awake || std::isnan(height)) return kNever;
  return std::abs(at(vertex).z - height);
}

double relief_at(const Ground& ground, std::uint32_t vertex) {
  const auto sunk = [&](std::uint32_t v) {
    const std::uint32_t column = ground.surface.column[v];
    return column == kNone ? 0.0 : static_cast<double>(ground.soil.original[column].z) - ground.surface.position[v].z;
  };
  double low = sunk(vertex), high = low;
  ground.surface.mesh.for_each_neighbour(
      vertex, [&](std::uint32_t u) { low = std::min(low, sunk(u)), high = std::max(high, sunk(u)); });
  return high - low;
}

void join_edge(Ground& ground, std::uint32_t vertex) {
  state::Surface& surface = ground.surface;
  state::Soil& soil = ground.soil;
  const std::array<std::uint32_t, 2> end = surface.bisection.parents(vertex);
  const Vec3 middle = 0.5f * (surface.position[end[0]] + surface.position[end[1]]);
  const auto touched = [&](std::uint32_t v) { return surface.column[v] != kNone; };
  if (touched(end[0]) || touched(end[1])) state::touch_column(surface, soil, vertex);
  const double lost = state::move_vertex(surface, vertex, middle);
  if (const std::uint32_t own = surface.column[vertex]; own != kNone) {
    soil.compacted[own] += lost;
    for (const std::uint32_t v : end) {
      // An end that was never touched is so before the triangles round it change.
      const std::uint32_t c = state::touch_column(surface, soil, v);
      soil.gained[c] += 0.5 * soil.gained[own], soil.compacted[c] += 0.5 * soil.compacted[own];
      soil.area[c] += 0.5f * soil.area[own];
    }
    soil.gained[own] = soil.compacted[own] = 0;
    soil.area[own] = soil.cell[own] = soil.plastic[own] = soil.loose[own] = soil.excess[own] = 0;
    soil.original[own] = soil.rest[own] = middle;
    for (state::Blast& blast : ground.blasts) {
      drop(own, blast.column, {&blast.push, &blast.thrown});
      drop(own, blast.landing, {&blast.landing_height});
    }
  }
  std::array<std::uint32_t, 4> corners{kNone, kNone, kNone, kNone};
  std::size_t count = 0;
  surface.mesh.for_each_neighbour(vertex, [&](std::uint32_t u) { corners[count++] = u; });
  surface.bisection.merge(surface.mesh, vertex);
  renew_cells(ground, corners);
  ground.touched.push_back(vertex);
}

}  // namespace divot::refine
