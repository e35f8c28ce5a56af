#include "settle/slump.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "laws/slope.h"

namespace divot::settle {
namespace {

constexpr int kMostSweeps = 8;
// Ground that would stand so high, m, does not slide at all: rock, roads.
constexpr double kStandsForEver = 100;
// Smaller changes of the excess are none, as a share of the height at which the soil stands.
constexpr double kSameExcess = 0.01;
constexpr std::size_t kGrain = 256;

// Whether ground that stands so high, m, stands for a while and then slides.
bool is_cohesive(double stands) { return stands > 0 && stands < kStandsForEver; }

struct Corner {
  Vec3d now, then;  // m: position, and before the first touch
  double loose;     // m
};

struct Site {
  const Ground& ground;
  std::span<const laws::Medium> media;
  std::span<const double> stands;  // [medium] m

  Corner corner(std::uint32_t vertex) const {
    const std::uint32_t column = ground.surface.column[vertex];
    const Vec3d now = to_double(ground.surface.position[vertex]);
    if (column == kNone) return {now, now, 0};
    return {now, to_double(ground.soil.original[column]), ground.soil.loose[column]};
  }
  const laws::Medium& medium(std::uint32_t vertex) const { return media[ground.surface.material[vertex]]; }
  // Height up to which the soil there stands vertically, m.
  double stands_to(std::uint32_t vertex) const { return stands[ground.surface.material[vertex]]; }
  bool has_cohesion(std::uint32_t vertex) const { return is_cohesive(stands_to(vertex)); }

  // How far a vertex stands above what its soil would lie at without cohesion, m.
  float excess(std::uint32_t vertex) const {
    const std::uint32_t column = ground.surface.column[vertex];
    return column == kNone ? 0 : ground.soil.excess[column];
  }
};

// What there may be to look at round a restless vertex.
constexpr std::uint8_t kSteepFace = 1, kSteepEdge = 2;

// Slopes below which there is nothing: the least of all soils, with a margin for rounding.
struct LeastSlopes {
  double face = 0;  // of a face that slides
  double edge = 0;  // of an edge down which cohesive ground falls beyond the slope of rest
};

constexpr double kNever = 1e9;

LeastSlopes least_slopes(std::span<const laws::Medium> media, double gravity) {
  constexpr double kMargin = 1 - 1e-6;
  LeastSlopes least{kNever, kNever};
  for (const laws::Medium& medium : media) {
    const double repose = medium.tan_repose;
    least.face = std::min(least.face, kMargin * (repose + laws::kAtRest));
    if (is_cohesive(laws::critical_height(medium, gravity))) least.edge = std::min(least.edge, kMargin * repose);
  }
  return least;
}

// Of cohesive ground: the highest that any way down from a vertex falls beyond the slope of rest, m. Each call carries
// the news one edge further; where nothing changes any more it is exact.
float find_excess(const Site& site, std::uint32_t vertex) {
  const Corner top = site.corner(vertex);
  const double repose = site.medium(vertex).tan_repose;
  double most = 0;
  site.ground.surface.mesh.for_each_neighbour(vertex, [&](std::uint32_t u) {
    const Vec3d way = top.now - to_double(site.ground.surface.position[u]);
    const double below = site.excess(u) + way.z, rest = repose * std::sqrt(way.x * way.x + way.y * way.y);
    if (below - rest <= most) return;
    const double before = top.loose <= 0 ? top.then.z - site.corner(u).then.z : rest;
    most = std::max(most, below - std::max(rest, before));
  });
  return static_cast<float>(most);
}

// Looks at places alone: far cheaper than what it saves. An excess changes only at a vertex where there is one, or
// that a steep edge joins to one that moved or whose own has changed.
std::uint8_t look_round(const Site& site, std::uint32_t vertex, const LeastSlopes& least) {
  const state::Surface& surface = site.ground.surface;
  const Vec3d centre = to_double(surface.position[vertex]);
  const bool open = surface.mesh.is_boundary(vertex);
  const double face = least.face * least.face, edge = least.edge * least.edge;
  std::uint8_t round = site.excess(vertex) > 0 ? kSteepEdge : 0;
  const auto look_along = [&](std::uint32_t neighbour, const Vec3d& way) {
    const bool steep = way.z * way.z > edge * (way.x * way.x + way.y * way.y);
    if (steep || site.excess(neighbour) > 0) round |= kSteepEdge;
  };
  surface.mesh.for_each_outgoing(vertex, [&](std::uint32_t h) {
    const std::uint32_t far = geometry::HalfEdgeMesh::prev(h);
    const std::uint32_t a = surface.mesh.target(h), b = surface.mesh.origin(far);
    const Vec3d u = to_double(surface.position[a]) - centre, v = to_double(surface.position[b]) - centre;
    const Vec3d normal = cross(u, v);
    if (normal.x * normal.x + normal.y * normal.y > face * normal.z * normal.z) round |= kSteepFace;
    look_along(a, u);
    if (open && surface.mesh.twin(far) == kNone) look_along(b, v);
  });
  return round;
}

void look_round_restless(const Site& site, const LeastSlopes& least, SlumpScratch& scratch, const Jobs& jobs) {
  const std::vector<std::uint32_t>& restless = site.ground.soil.restless;
  scratch.round.resize(restless.size());
  const auto work = [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) scratch.round[k] = look_round(site, restless[k], least);
  };
  jobs.for_ranges(restless.size(), kGrain, std::ref(work));
}

// Brings `soil.excess` up to date at and round the restless ground where it has cohesion; `next` gets what changed.
void update_excess(Ground& ground, const Site& site, SlumpScratch& scratch, const Jobs& jobs) {
  const auto add = [&](std::uint32_t vertex) {
    if (site.has_cohesion(vertex)) scratch.set.insert(vertex);
  };
  for (std::size_t k = 0; k < ground.soil.restless.size(); ++k) {
    if (!(scratch.round[k] & kSteepEdge)) continue;
    add(ground.soil.restless[k]);
    ground.surface.mesh.for_each_neighbour(ground.soil.restless[k], add);
  }
  std::vector<std::uint32_t>& vertices = scratch.vertices;
  scratch.set.drain(vertices);
  scratch.excess.resize(vertices.size());
  const auto work = [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) scratch.excess[k] = find_excess(site, vertices[k]);
  };
  jobs.for_ranges(vertices.size(), kGrain, std::ref(work));
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const double same = kSameExcess * site.stands_to(vertices[k]);
    if (std::abs(scratch.excess[k] - site.excess(vertices[k])) <= same) continue;
    ground.soil.excess[state::touch_column(ground.surface, ground.soil, vertices[k])] = scratch.excess[k];
    scratch.next.push_back(vertices[k]);
  }
}

// Faces round which something is steep.
void find_steep(const Ground& ground, SlumpScratch& scratch) {
  for (std::size_t k = 0; k < scratch.round.size(); ++k)
    if (scratch.round[k] & kSteepFace)
      ground.surface.mesh.for_each_face(ground.soil.restless[k], [&](std::uint32_t face) { scratch.set.insert(face); });
  scratch.set.drain(scratch.faces);
}

}  // namespace

Slopes sliding_slopes(std::span<const laws::Medium> media, double gravity) {
  if (!(gravity > 0)) return {static_cast<float>(kNever), static_cast<float>(kNever), false};
  constexpr double kRoundedMargin = 0.999;
  const LeastSlopes least = least_slopes(media, gravity);
  const auto squared = [](double slope) { return static_cast<float>(kRoundedMargin * slope * slope); };
  return {squared(least.face), squared(least.edge), least.edge < kNever};
}

void slump(Ground& ground, std::span<const state::Body> bodies, std::span<const laws::Medium> media, double gravity,
           double dt, SlumpScratch& scratch, const Jobs& jobs) {
  if (!(gravity > 0)) return ground.soil.restless.clear();
  scratch.stands.clear();
  for (const laws::Medium& medium : media) scratch.stands.push_back(laws::critical_height(medium, gravity));
  const Site site{ground, media, scratch.stands};
  const LeastSlopes least = least_slopes(media, gravity);
  scratch.next.clear();
  look_round_restless(site, least, scratch, jobs);
  update_excess(ground, site, scratch, jobs);
  find_steep(ground, scratch);

  const SlopeLaws slope_laws{media, scratch.stands, gravity};
  scratch.patch.build(ground, slope_laws, bodies, scratch.faces, jobs);
  float distance = 0;
  int sweeps = 1;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    const double overshoots = scratch.patch.find_slides(slope_laws, dt, jobs);
    if (sweep == 0) sweeps = static_cast<int>(std::clamp<double>(std::ceil(overshoots), 1, kMostSweeps));
    distance += scratch.patch.slide(dt / sweeps, jobs);
  }
  scratch.patch.for_each_moved([&](std::uint32_t vertex, double volume, double area) {
    bring(ground, state::touch_column(ground.surface, ground.soil, vertex), volume, area);
    scratch.next.push_back(vertex);
  });
  ground.moved.distance += distance, ground.moved.free_distance += distance;
  scratch.set.sort_unique(scratch.next);
  std::swap(ground.soil.restless, scratch.next);
}

}  // namespace divot::settle
