#include "refine/halve.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <numeric>

namespace divot::refine {
namespace {

using geometry::HalfEdgeMesh;
using state::original_place;

float twice_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// An edge that is halved: its ends and the corners across from it, the second kNone at the border.
struct Edge {
  std::array<std::uint32_t, 2> end, across;
  float moves = 0;  // m^2, area that each end gives up
};

Edge edge_of(const state::Surface& surface, const state::Soil& soil, std::uint32_t h) {
  const HalfEdgeMesh& mesh = surface.mesh;
  Edge edge{{mesh.origin(h), mesh.target(h)}, {mesh.origin(HalfEdgeMesh::prev(h)), kNone}};
  const std::uint32_t g = mesh.twin(h);
  if (g != kNone) edge.across[1] = mesh.origin(HalfEdgeMesh::prev(g));
  const auto at = [&](std::uint32_t v) { return original_place(surface, soil, v); };
  float twice = twice_area(at(edge.end[0]), at(edge.end[1]), at(edge.across[0]));
  if (g != kNone) twice += twice_area(at(edge.end[1]), at(edge.end[0]), at(edge.across[1]));
  edge.moves = twice / 12;
  return edge;
}

// Makes arrays of the surface as long as its mesh has vertices.
void grow(state::Surface& surface) {
  const std::size_t count = surface.mesh.vertex_count();
  surface.position.resize(count), surface.material.resize(count), surface.column.resize(count, kNone);
}

// The column of a vertex as if it had just been touched, with no area.
std::uint32_t empty_column(Ground& ground, std::uint32_t vertex) {
  const bool is_new = ground.surface.column[vertex] == kNone;
  const std::uint32_t column = state::touch_column(ground.surface, ground.soil, vertex);
  state::Soil& soil = ground.soil;
  if (!is_new) {
    soil.particle[column] = kNone;
    soil.original[column] = soil.rest[column] = ground.surface.position[vertex];
    soil.shear[column] = {};
    soil.plastic[column] = soil.loose[column] = soil.excess[column] = 0;
    soil.gained[column] = soil.compacted[column] = 0;
  }
  soil.area[column] = 0;
  return column;
}

// Half of what lies at both ends, where an untouched end has its place and nothing else.
void inherit_column(Ground& ground, const Edge& edge, std::uint32_t vertex) {
  state::Surface& surface = ground.surface;
  state::Soil& soil = ground.soil;
  const std::uint32_t own = empty_column(ground, vertex);
  soil.original[own] = soil.rest[own] = {};
  for (const std::uint32_t v : edge.end) {
    const std::uint32_t c = surface.column[v];
    soil.original[own] += 0.5f * original_place(surface, soil, v);
    soil.rest[own] += 0.5f * (c == kNone ? surface.position[v] : soil.rest[c]);
    soil.area[own] += edge.moves;
    if (c == kNone) continue;
    soil.plastic[own] += 0.5f * soil.plastic[c];
    soil.shear[own] += 0.5f * soil.shear[c];
    soil.loose[own] += 0.5f * soil.loose[c];
    soil.excess[own] += 0.5f * soil.excess[c];
    const double part = soil.area[c] > 0 ? std::min(1.0, static_cast<double>(edge.moves) / soil.area[c]) : 0;
    for (auto* book : {&soil.gained, &soil.compacted}) {
      const double goes = part * (*book)[c];
      (*book)[own] += goes, (*book)[c] -= goes;
    }
    soil.area[c] -= edge.moves;
  }
}

// Index of a column in a list that ascends by vertex: where it is, or where it would be.
std::size_t index_of(const std::vector<std::uint32_t>& columns, const state::Soil& soil, std::uint32_t vertex) {
  const auto at = std::lower_bound(columns.begin(), columns.end(), vertex,
                                   [&](std::uint32_t c, std::uint32_t v) { return soil.vertex[c] < v; });
  return static_cast<std::size_t>(at - columns.begin());
}

bool is_at(const std::vector<std::uint32_t>& columns, std::size_t k, const state::Soil& soil, std::uint32_t vertex) {
  return k < columns.size() && soil.vertex[columns[k]] == vertex;
}

// Adds a column halfway between two of a list with the numbers that go with it; an end that is not there counts as 0.
void inherit_entry(const state::Soil& soil, const Edge& edge, std::uint32_t vertex, std::uint32_t column,
                   std::vector<std::uint32_t>& columns, std::initializer_list<std::vector<float>*> numbers) {
  bool any = false;
  for (const std::uint32_t v : edge.end) any |= is_at(columns, index_of(columns, soil, v), soil, v);
  if (!any) return;
  const auto place = static_cast<std::ptrdiff_t>(index_of(columns, soil, vertex));
  for (std::vector<float>* list : numbers) {
    float sum = 0;
    for (const std::uint32_t v : edge.end)
      if (const std::size_t k = index_of(columns, soil, v); is_at(columns, k, soil, v)) sum += 0.5f * (*list)[k];
    list->insert(list->begin() + place, sum);
  }
  columns.insert(columns.begin() + place, column);
}

void inherit_blasts(Ground& ground, const Edge& edge, std::uint32_t vertex) {
  const std::uint32_t column = ground.surface.column[vertex];
  for (state::Blast& blast : ground.blasts) {
    inherit_entry(ground.soil, edge, vertex, column, blast.column, {&blast.push, &blast.thrown});
    inherit_entry(ground.soil, edge, vertex, column, blast.landing, {&blast.landing_height});
  }
}

std::uint32_t row_of(const Ground& ground, std::uint32_t vertex) {
  const std::uint32_t column = vertex == kNone ? kNone : ground.surface.column[vertex];
  return column == kNone ? kNone : ground.soil.particle[column];
}

bool is_awake(const Ground& ground, std::uint32_t vertex) {
  const std::uint32_t i = row_of(ground, vertex);
  return i != kNone && (ground.particles.hold[i] == Hold::free || ground.particles.hold[i] == Hold::carried);
}

// A row for a vertex between two particles one of which is awake, or an anchor beside a corner that is.
void inherit_row(Ground& ground, const Edge& edge, std::uint32_t vertex) {
  state::Particles& p = ground.particles;
  const auto [a, b] = edge.end;
  const bool moves = is_awake(ground, a) || is_awake(ground, b);
  const bool beside = is_awake(ground, edge.across[0]) || is_awake(ground, edge.across[1]);
  if (!moves && !beside) return;
  const std::uint32_t i = row_of(ground, a), j = row_of(ground, b), column = ground.surface.column[vertex];
  const auto half = [&](const std::vector<float>& of) { return 0.5f * (of[i] + of[j]); };
  ground.soil.particle[column] = static_cast<std::uint32_t>(p.size());
  const Vec3 place = moves ? Vec3{half(p.x), half(p.y), half(p.z)} : ground.surface.position[vertex];
  for (auto* list : {&p.vx, &p.vy, &p.vz, &p.fx, &p.fy, &p.fz, &p.flow_rate}) list->push_back(moves ? half(*list) : 0);
  p.x.push_back(place.x), p.y.push_back(place.y), p.z.push_back(place.z);
  p.vertex.push_back(vertex), p.column.push_back(column);
  p.mass.push_back(0);  // renew_cells() says it
  p.held_pull.push_back(0), p.yielded.push_back(0), p.carrier.push_back(kNone);
  p.material.push_back(ground.surface.material[vertex]);
  p.hold.push_back(moves ? Hold::free : Hold::anchor);
  p.still_steps.push_back(moves ? std::min(p.still_steps[i], p.still_steps[j]) : std::uint16_t{0});
}

// What a map says of the place, unless the ground at an end of the edge has become another one than it says there.
std::uint8_t material_of(const Ground& ground, const Edge& edge, const Vec3& place) {
  const state::Surface& surface = ground.surface;
  const std::uint8_t older = surface.material[std::min(edge.end[0], edge.end[1])];
  if (!ground.material_at) return older;
  const auto says = [&](const Vec3& p) {
    const Vec3d at = to_double(p) + surface.origin;
    return ground.material_at(at.x, at.y);
  };
  for (const std::uint32_t v : edge.end)
    if (says(original_place(surface, ground.soil, v)) != surface.material[v]) return older;
  return says(place);
}

}  // namespace

double squared_length(const state::Surface& surface, const state::Soil& soil, std::uint32_t half_edge) {
  const Vec3d a = to_double(original_place(surface, soil, surface.mesh.origin(half_edge)));
  const Vec3d b = to_double(original_place(surface, soil, surface.mesh.target(half_edge)));
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

std::uint32_t halve_edge(Ground& ground, std::uint32_t half_edge) {
  state::Surface& surface = ground.surface;
  const Edge edge = edge_of(surface, ground.soil, half_edge);
  const std::uint32_t vertex = surface.bisection.split(surface.mesh, half_edge);
  grow(surface);
  const auto [a, b] = edge.end;
  surface.position[vertex] = 0.5f * (surface.position[a] + surface.position[b]);
  const Vec3 before = 0.5f * (original_place(surface, ground.soil, a) + original_place(surface, ground.soil, b));
  surface.material[vertex] = material_of(ground, edge, before);
  const auto touched = [&](std::uint32_t v) { return v != kNone && surface.column[v] != kNone; };
  if (touched(a) || touched(b) || touched(vertex)) {
    inherit_column(ground, edge, vertex);
    inherit_blasts(ground, edge, vertex);
  }
  inherit_row(ground, edge, vertex);
  renew_cells(ground, std::array{a, b, edge.across[0], edge.across[1], vertex});
  ground.touched.push_back(vertex);
  return vertex;
}

void renew_cells(Ground& ground, std::span<const std::uint32_t> vertices) {
  for (const std::uint32_t v : vertices) {
    const std::uint32_t column = v == kNone ? kNone : ground.surface.column[v];
    if (column == kNone) continue;
    const float cell = ground.soil.cell[column] = state::cell_area_before(ground.surface, ground.soil, v);
    if (const std::uint32_t i = ground.soil.particle[column]; i != kNone)
      ground.particles.mass[i] = ground.media[ground.particles.material[i]].areal_mass * cell;
  }
}

void sort_rows(state::Particles& particles, state::Soil& soil) {
  const std::vector<std::uint32_t>& vertex = particles.vertex;
  if (std::is_sorted(vertex.begin(), vertex.end())) return;
  std::vector<std::uint32_t> order(particles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) { return vertex[i] < vertex[j]; });
  particles.for_each_array([&](auto& array) {
    auto sorted = array;
    for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = array[order[i]];
    array.swap(sorted);
  });
  for (std::size_t i = 0; i < particles.size(); ++i) soil.particle[particles.column[i]] = static_cast<std::uint32_t>(i);
}

}  // namespace divot::refine
