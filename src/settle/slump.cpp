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

struct Corner {
  std::uint32_t vertex;
  Vec3d now, then;  // m: position, and before the first touch
  double loose;     // m
};

struct Site {
  const Ground& ground;
  std::span<const laws::Medium> media;
  double gravity;

  Corner corner(std::uint32_t vertex) const {
    const std::uint32_t column = ground.surface.column[vertex];
    const Vec3d now = to_double(ground.surface.position[vertex]);
    if (column == kNone) return {vertex, now, now, 0};
    return {vertex, now, to_double(ground.soil.original[column]), ground.soil.loose[column]};
  }
  const laws::Medium& medium(std::uint32_t vertex) const { return media[ground.surface.material[vertex]]; }

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

// Soil that a face's slide brings to its corner k, m^3 per unit of mobility and time: linear finite elements.
double share_of_corner(const std::array<Vec3d, 3>& p, const Slide& slide, std::uint32_t k) {
  const Vec3d &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
  return -(slide.x * (a.y - b.y) + slide.y * (b.x - a.x)) / twice_area(p[0], p[1], p[2]);
}

// Whether a face slides, and what then flows through it. The same bits whichever corner asks.
bool look_at(const Site& site, std::uint32_t face, Slide& slide) {
  std::array<Corner, 3> p;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t vertex = site.ground.surface.mesh.origin(3 * face + k);
    if (site.is_held(vertex)) return false;
    p[k] = site.corner(vertex);
  }
  const double area = twice_area(p[0].now, p[1].now, p[2].now);
  if (!(area > 0)) return false;
  const Gradient g = gradient(p[0].now, p[1].now, p[2].now, area);
  const double slope = g.size();
  // The soil at the highest corner is what would slide.
  const Corner& top = *std::max_element(p.begin(), p.end(), [](auto& a, auto& b) { return a.now.z < b.now.z; });
  const laws::Medium& medium = site.medium(top.vertex);
  if (slope <= medium.tan_repose + kAtRest) return false;
  const double intact = intact_slope(p, medium.tan_repose);
  const auto base = [](const Corner& c) { return c.now - Vec3d{0, 0, c.loose}; };
  const double below = gradient(base(p[0]), base(p[1]), base(p[2]), area).size();
  const bool only_loose = std::min(slope, below) <= intact + kAtRest;
  if (only_loose && top.loose <= kThinnest * site.ground.surface.spacing) return false;
  const double rest = only_loose ? medium.tan_repose : intact;
  const double stands = laws::critical_height(medium, site.gravity);
  if (stands > 0 && site.excess(top.vertex) <= stands) return false;

  double low = p[0].now.z, high = low, height = 0, longest = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    low = std::min(low, p[k].now.z), high = std::max(high, p[k].now.z);
    height = std::max(height, std::abs(p[k].now.z - p[k].then.z));
    const Vec3d edge = p[(k + 1) % 3].now - p[k].now;
    longest = std::max(longest, edge.x * edge.x + edge.y * edge.y);
  }
  const double share = 0.5 * area * (1 - rest / slope);
  slide = {face, share * g.x, share * g.y, laws::slide_mobility(std::max(height, high - low), site.gravity),
           area * area / (6 * longest)};
  // What lies loose on ground that stands goes, but takes none of that ground along: the face's part of the column.
  slide.most = std::numeric_limits<double>::infinity();
  if (only_loose) {
    const std::array<Vec3d, 3> place = {p[0].now, p[1].now, p[2].now};
    const double leaves = -share_of_corner(place, slide, static_cast<std::uint32_t>(&top - p.data()));
    if (leaves > 0) slide.most = top.loose * area / 6 / leaves;
  }
  return true;
}

void sort_unique(std::vector<std::uint32_t>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

// Of cohesive ground: the highest that any way down from a vertex falls beyond the slope of rest, m. Each call carries
// the news one edge further; where nothing changes any more it is exact.
float find_excess(const Site& site, std::uint32_t vertex) {
  const Corner top = site.corner(vertex);
  const double repose = site.medium(vertex).tan_repose;
  double most = 0;
  site.ground.surface.mesh.for_each_neighbour(vertex, [&](std::uint32_t u) {
    const Corner foot = site.corner(u);
    double rest = repose * std::hypot(top.now.x - foot.now.x, top.now.y - foot.now.y);
    if (top.loose <= 0) rest = std::max(rest, top.then.z - foot.then.z);
    const double fall = top.now.z - foot.now.z - rest;
    most = std::max(most, site.excess(u) + fall);
  });
  return static_cast<float>(most);
}

// Brings `soil.excess` up to date at and round the restless ground where it has cohesion; `next` gets what changed.
void update_excess(Ground& ground, const Site& site, SlumpScratch& scratch) {
  std::vector<std::uint32_t>& vertices = scratch.vertices;
  vertices.clear();
  const auto add = [&](std::uint32_t vertex) {
    const double stands = laws::critical_height(site.medium(vertex), site.gravity);
    if (stands > 0 && stands < kStandsForEver) vertices.push_back(vertex);
  };
  for (const std::uint32_t vertex : ground.soil.restless) {
    add(vertex);
    ground.surface.mesh.for_each_neighbour(vertex, add);
  }
  sort_unique(vertices);
  scratch.excess.resize(vertices.size());
  for (std::size_t k = 0; k < vertices.size(); ++k) scratch.excess[k] = find_excess(site, vertices[k]);
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const double stands = laws::critical_height(site.medium(vertices[k]), site.gravity);
    if (std::abs(scratch.excess[k] - site.excess(vertices[k])) <= kSameExcess * stands) continue;
    ground.soil.excess[state::touch_column(ground.surface, ground.soil, vertices[k])] = scratch.excess[k];
    scratch.next.push_back(vertices[k]);
  }
}

void find_slides(const Site& site, SlumpScratch& scratch, const Jobs& jobs) {
  scratch.faces.clear();
  for (const std::uint32_t vertex : site.ground.soil.restless)
    site.ground.surface.mesh.for_each_face(vertex, [&](std::uint32_t face) { scratch.faces.push_back(face); });
  sort_unique(scratch.faces);
  scratch.found.resize(scratch.faces.size());
  const auto work = [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      if (!look_at(site, scratch.faces[k], scratch.found[k])) scratch.found[k].face = kNone;
  };
  jobs.for_ranges(scratch.faces.size(), kGrain, std::ref(work));  // by reference: a copy would be an allocation
  scratch.slides.clear();
  for (const Slide& slide : scratch.found)
    if (slide.face != kNone) scratch.slides.push_back(slide);
}

// Soil that comes to each corner of what slides in a sweep of `dt`, gathered over its faces in their order.
void gather_inflow(const Ground& ground, double dt, SlumpScratch& scratch, const Jobs& jobs) {
  const state::Surface& surface = ground.surface;
  scratch.vertices.clear();
  for (const Slide& slide : scratch.slides)
    for (std::uint32_t h = 3 * slide.face; h < 3 * slide.face + 3; ++h)
      scratch.vertices.push_back(surface.mesh.origin(h));
  sort_unique(scratch.vertices);
  scratch.inflow.assign(scratch.vertices.size(), 0);
  const auto work = [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      surface.mesh.for_each_outgoing(scratch.vertices[k], [&](std::uint32_t h) {
        const auto slide = std::lower_bound(scratch.slides.begin(), scratch.slides.end(), h / 3,
                                            [](const Slide& s, std::uint32_t face) { return s.face < face; });
        if (slide == scratch.slides.end() || slide->face != h / 3) return;
        std::array<Vec3d, 3> p;
        for (std::uint32_t j = 0; j < 3; ++j) p[j] = to_double(surface.position[surface.mesh.origin(3 * (h / 3) + j)]);
        const double flows = std::min({slide->wanted * dt, slide->stable, slide->most});
        scratch.inflow[k] += flows * share_of_corner(p, *slide, h % 3);
      });
  };
  jobs.for_ranges(scratch.vertices.size(), kGrain, std::ref(work));  // by reference: a copy would be an allocation
}

int plan_sweeps(const std::vector<Slide>& slides, double dt) {
  double wanted = 1;
  for (const Slide& slide : slides) wanted = std::max(wanted, slide.wanted * dt / slide.stable);
  return static_cast<int>(std::min<double>(std::ceil(wanted), kMostSweeps));
}

}  // namespace

void slump(Ground& ground, std::span<const laws::Medium> media, double gravity, double dt, SlumpScratch& scratch,
           const Jobs& jobs) {
  if (!(gravity > 0)) return ground.soil.restless.clear();
  const Site site{ground, media, gravity};
  int sweeps = 1;
  for (int sweep = 0; sweep < sweeps && !ground.soil.restless.empty(); ++sweep) {
    scratch.next.clear();
    update_excess(ground, site, scratch);
    find_slides(site, scratch, jobs);
    if (sweep == 0) sweeps = plan_sweeps(scratch.slides, dt);
    gather_inflow(ground, dt / sweeps, scratch, jobs);
    float furthest = 0;
    for (std::size_t k = 0; k < scratch.vertices.size(); ++k) {
      const std::uint32_t column = state::touch_column(ground.surface, ground.soil, scratch.vertices[k]);
      furthest = std::max(furthest, std::abs(bring(ground, column, scratch.inflow[k])));
    }
    ground.moved.distance += furthest, ground.moved.free_distance += furthest;
    scratch.next.insert(scratch.next.end(), scratch.vertices.begin(), scratch.vertices.end());
    sort_unique(scratch.next);
    std::swap(ground.soil.restless, scratch.next);
  }
}

}  // namespace divot::settle
