#include "settle/slump.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "laws/slope.h"

namespace divot::settle {
namespace {

constexpr int kMostSweeps = 8;
// Slopes count as at rest up to this much beyond that of rest: half a degree.
constexpr double kAtRest = 0.01;
// Ground that would stand so high, m, does not slide at all: rock, roads.
constexpr double kStandsForEver = 100;
// Ground that moves faster than this share of what falls by a spacing has not come down yet.
constexpr double kFast = 0.1;
// Intact ground that was steeper than loose soil stands holds up to so many times its slope.
constexpr double kToSpare = 1.1;
// Soil that lies thinner than this share of a spacing does not slide by itself.
constexpr double kThinnest = 1e-3;
// Smaller changes of the excess are none, as a share of the height at which the soil stands.
constexpr double kSameExcess = 0.01;
constexpr std::size_t kGrain = 256;

// Whether ground that stands so high, m, stands for a while and then slides.
bool is_cohesive(double stands) { return stands > 0 && stands < kStandsForEver; }

struct Corner {
  std::uint32_t vertex;
  Vec3d now, then;  // m: position, and before the first touch
  double loose;     // m
};

struct Site {
  const Ground& ground;
  std::span<const laws::Medium> media;
  std::span<const double> stands;  // [medium] m
  double gravity;

  Corner corner(std::uint32_t vertex) const {
    const std::uint32_t column = ground.surface.column[vertex];
    const Vec3d now = to_double(ground.surface.position[vertex]);
    if (column == kNone) return {vertex, now, now, 0};
    return {vertex, now, to_double(ground.soil.original[column]), ground.soil.loose[column]};
  }
  const laws::Medium& medium(std::uint32_t vertex) const { return media[ground.surface.material[vertex]]; }
  // Height up to which the soil there stands vertically, m.
  double stands_to(std::uint32_t vertex) const { return stands[ground.surface.material[vertex]]; }
  bool has_cohesion(std::uint32_t vertex) const { return is_cohesive(stands_to(vertex)); }

  // A body has it, a blast makes it flow, or it moves as fast as what slides.
  bool is_held(std::uint32_t vertex) const {
    const std::uint32_t column = ground.surface.column[vertex];
    if (column == kNone) return false;
    const std::uint32_t i = ground.soil.particle[column];
    const state::Particles& p = ground.particles;
    if (i == kNone || p.hold[i] == Hold::anchor) return false;
    const double fast = kFast * kFast * gravity * ground.surface.spacing;
    return p.hold[i] == Hold::carried || p.flow_rate[i] > 0 || dot(p.velocity(i), p.velocity(i)) > fast;
  }

  // How far a vertex stands above what its soil would lie at without cohesion, m.
  float excess(std::uint32_t vertex) const {
    const std::uint32_t column = ground.surface.column[vertex];
    return column == kNone ? 0 : ground.soil.excess[column];
  }
};

struct Gradient {
  double x = 0, y = 0;
  double size() const { return std::sqrt(x * x + y * y); }
};

// Of a plane through three places; `twice_area` of its shadow.
Gradient gradient(const Vec3d& a, const Vec3d& b, const Vec3d& c, double twice_area) {
  const Vec3d u = b - a, v = c - a;
  return {(u.z * v.y - v.z * u.y) / twice_area, (v.z * u.x - u.z * v.x) / twice_area};
}

double twice_area(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Steepest slope at which intact ground of a face rests: as it stood before anything touched it, with a little to
// spare, or else a pit in a steep slope would pull down all that lies above it, to the top.
double intact_slope(const std::array<Corner, 3>& p, double repose) {
  const double area = twice_area(p[0].then, p[1].then, p[2].then);
  const double before = area > 0 ? gradient(p[0].then, p[1].then, p[2].then, area).size() : 0;
  return before > repose ? kToSpare * before : repose;
}

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
    least.face = std::min(least.face, kMargin * (repose + kAtRest));
    if (is_cohesive(laws::critical_height(medium, gravity))) least.edge = std::min(least.edge, kMargin * repose);
  }
  return least;
}

// Soil that a flow through a face, uphill where positive, brings to each of its corners: linear finite elements.
std::array<double, 3> shares(const std::array<Corner, 3>& p, const Gradient& flow, double area) {
  std::array<double, 3> share;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Vec3d &a = p[(k + 1) % 3].now, &b = p[(k + 2) % 3].now;
    share[k] = -(flow.x * (a.y - b.y) + flow.y * (b.x - a.x)) / area;
  }
  return share;
}

// Whether a face slides, and what then flows through it. The same bits whichever corner asks.
bool look_at(const Site& site, std::uint32_t face, const LeastSlopes& least, Slide& slide) {
  const state::Surface& surface = site.ground.surface;
  const auto vertex = [&](std::uint32_t k) { return surface.mesh.origin(3 * face + k); };
  std::array<Vec3d, 3> place;
  for (std::uint32_t k = 0; k < 3; ++k) place[k] = to_double(surface.position[vertex(k)]);
  const double area = twice_area(place[0], place[1], place[2]);
  if (!(area > 0)) return false;
  const Gradient g = gradient(place[0], place[1], place[2], area);
  const double slope = g.size();
  if (slope <= least.face) return false;
  std::array<Corner, 3> p;
  for (std::uint32_t k = 0; k < 3; ++k) {
    if (site.is_held(vertex(k))) return false;
    p[k] = site.corner(vertex(k));
  }
  // The soil at the highest corner is what would slide.
  const Corner& top = *std::max_element(p.begin(), p.end(), [](auto& a, auto& b) { return a.now.z < b.now.z; });
  const laws::Medium& medium = site.medium(top.vertex);
  if (slope <= medium.tan_repose + kAtRest) return false;
  if (const double stands = site.stands_to(top.vertex); stands > 0)
    if (laws::counted_height(site.excess(top.vertex), slope, medium.tan_repose) <= stands) return false;
  const double intact = intact_slope(p, medium.tan_repose);
  const auto base = [](const Corner& c) { return c.now - Vec3d{0, 0, c.loose}; };
  const double below = gradient(base(p[0]), base(p[1]), base(p[2]), area).size();
  const bool only_loose = std::min(slope, below) <= intact + kAtRest;
  if (only_loose && top.loose <= kThinnest * surface.spacing) return false;
  const double rest = only_loose ? medium.tan_repose : intact;

  double low = p[0].now.z, high = low, height = 0, longest = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    low = std::min(low, p[k].now.z), high = std::max(high, p[k].now.z);
    height = std::max(height, std::abs(p[k].now.z - p[k].then.z));
    const Vec3d edge = p[(k + 1) % 3].now - p[k].now;
    longest = std::max(longest, edge.x * edge.x + edge.y * edge.y);
  }
  const double share = 0.5 * area * (1 - rest / slope);
  slide = {face, shares(p, {share * g.x, share * g.y}, area),
           laws::slide_mobility(std::max(height, high - low), site.gravity), area * area / (6 * longest),
           std::numeric_limits<double>::infinity()};
  // What lies loose on ground that stands goes, but takes none of that ground along: the face's part of the column.
  if (only_loose) {
    const double leaves = -slide.share[static_cast<std::size_t>(&top - p.data())];
    if (leaves > 0) slide.most = top.loose * area / 6 / leaves;
  }
  return true;
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

void find_slides(const Site& site, const LeastSlopes& least, SlumpScratch& scratch, const Jobs& jobs) {
  for (std::size_t k = 0; k < scratch.round.size(); ++k)
    if (scratch.round[k] & kSteepFace)
      site.ground.surface.mesh.for_each_face(site.ground.soil.restless[k],
                                             [&](std::uint32_t face) { scratch.set.insert(face); });
  scratch.set.drain(scratch.faces);
  scratch.found.resize(scratch.faces.size());
  const auto work = [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      if (!look_at(site, scratch.faces[k], least, scratch.found[k])) scratch.found[k].face = kNone;
  };
  jobs.for_ranges(scratch.faces.size(), kGrain, std::ref(work));  // by reference: a copy would be an allocation
  scratch.slides.clear();
  for (const Slide& slide : scratch.found)
    if (slide.face != kNone) scratch.slides.push_back(slide);
}

// Soil that comes to each corner of what slides in a sweep of `dt`, gathered over its faces in their order.
void gather_inflow(const Ground& ground, double dt, SlumpScratch& scratch, const Jobs& jobs) {
  const state::Surface& surface = ground.surface;
  for (const Slide& slide : scratch.slides) {
    scratch.sliding.insert(slide.face);
    for (std::uint32_t h = 3 * slide.face; h < 3 * slide.face + 3; ++h) scratch.set.insert(surface.mesh.origin(h));
  }
  scratch.set.drain(scratch.vertices);
  scratch.sliding.list(scratch.faces);
  scratch.inflow.assign(scratch.vertices.size(), 0);
  const auto work = [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      surface.mesh.for_each_outgoing(scratch.vertices[k], [&](std::uint32_t h) {
        const std::uint32_t index = scratch.sliding.index_of(h / 3);
        if (index == kNone) return;
        const Slide& slide = scratch.slides[index];
        scratch.inflow[k] += std::min({slide.wanted * dt, slide.stable, slide.most}) * slide.share[h % 3];
      });
  };
  jobs.for_ranges(scratch.vertices.size(), kGrain, std::ref(work));  // by reference: a copy would be an allocation
  scratch.sliding.clear();
}

int plan_sweeps(const std::vector<Slide>& slides, double dt) {
  double wanted = 1;
  for (const Slide& slide : slides) wanted = std::max(wanted, slide.wanted * dt / slide.stable);
  return static_cast<int>(std::min<double>(std::ceil(wanted), kMostSweeps));
}

}  // namespace

Slopes sliding_slopes(std::span<const laws::Medium> media, double gravity) {
  if (!(gravity > 0)) return {static_cast<float>(kNever), static_cast<float>(kNever), false};
  constexpr double kRoundedMargin = 0.999;
  const LeastSlopes least = least_slopes(media, gravity);
  const auto squared = [](double slope) { return static_cast<float>(kRoundedMargin * slope * slope); };
  return {squared(least.face), squared(least.edge), least.edge < kNever};
}

void slump(Ground& ground, std::span<const laws::Medium> media, double gravity, double dt, SlumpScratch& scratch,
           const Jobs& jobs) {
  if (!(gravity > 0)) return ground.soil.restless.clear();
  scratch.stands.clear();
  for (const laws::Medium& medium : media) scratch.stands.push_back(laws::critical_height(medium, gravity));
  const Site site{ground, media, scratch.stands, gravity};
  const LeastSlopes least = least_slopes(media, gravity);
  int sweeps = 1;
  for (int sweep = 0; sweep < sweeps && !ground.soil.restless.empty(); ++sweep) {
    scratch.next.clear();
    look_round_restless(site, least, scratch, jobs);
    update_excess(ground, site, scratch, jobs);
    find_slides(site, least, scratch, jobs);
    if (sweep == 0) sweeps = plan_sweeps(scratch.slides, dt);
    gather_inflow(ground, dt / sweeps, scratch, jobs);
    float furthest = 0;
    for (std::size_t k = 0; k < scratch.vertices.size(); ++k) {
      const std::uint32_t column = state::touch_column(ground.surface, ground.soil, scratch.vertices[k]);
      furthest = std::max(furthest, std::abs(bring(ground, column, scratch.inflow[k])));
    }
    ground.moved.distance += furthest, ground.moved.free_distance += furthest;
    scratch.next.insert(scratch.next.end(), scratch.vertices.begin(), scratch.vertices.end());
    scratch.set.sort_unique(scratch.next);
    std::swap(ground.soil.restless, scratch.next);
  }
}

}  // namespace divot::settle
