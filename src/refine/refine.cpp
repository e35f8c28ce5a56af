#include "refine/refine.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "refine/join.h"
#include "state/region.h"

namespace divot::refine {
namespace {

// Beside a body the ground is fine for so many edges, and for this share of the width that the body presses: soil comes
// up there.
constexpr double kBeside = 2.5, kBermWidth = 0.5;
// The ground in a body's way is made fine for so many edges, or steps, in advance, and the body may leave that way by
// so many edges before it is looked at again.
constexpr double kAheadEdges = 8, kAheadSteps = 4, kSlack = 2;
// Out of a crater the wanted edge grows from this many radii on, up to the end of what it throws or heaves.
constexpr double kRim = 1.4, kGrowth = 4, kCraterEnd = 4;
// In a step one in so many of the added vertices is looked at, whether it may go.
constexpr std::uint32_t kShare = 256, kLeast = 64;
// When more than this share of the budget is used, what shows least goes first: the tolerance grows up to so many times
// as large, and so does the number that is looked at.
constexpr double kPlenty = 0.5, kMostTolerance = 1e4, kMostLooks = 32;

// A face from above.
struct Disc {
  float x, y, radius, top;
};

Disc disc_of(const state::Surface& surface, std::uint32_t face) {
  Vec3 p[3];
  for (std::uint32_t k = 0; k < 3; ++k) p[k] = surface.position[surface.mesh.origin(3 * face + k)];
  Disc disc{(p[0].x + p[1].x + p[2].x) / 3, (p[0].y + p[1].y + p[2].y) / 3, 0, std::max({p[0].z, p[1].z, p[2].z})};
  for (const Vec3& corner : p) disc.radius = std::max(disc.radius, std::hypot(corner.x - disc.x, corner.y - disc.y));
  return disc;
}

// What a body may touch on its way.
struct Reach {
  const geometry::PosedSolid& posed;
  Vec3d way;      // m
  double beside;  // m
  double below;   // m

  math::Aabb box() const {
    const Vec3d down{0, 0, std::min(0.0, way.z) - below}, side{beside, beside, 0}, along{way.x, way.y, 0};
    math::Aabb around;
    for (const Vec3d& shift : {Vec3d{}, along}) {
      around.include(to_float(posed.low() + shift - side + down));
      around.include(to_float(posed.high() + shift + side));
    }
    around.high.z = math::Aabb::kInf;
    return around;
  }
  bool meets(const Disc& d) const {
    // Where on its way the body comes nearest.
    const Vec3d from = Vec3d{d.x, d.y, 0} - posed.position();
    const double squared = way.x * way.x + way.y * way.y, along = from.x * way.x + from.y * way.y;
    const double at = squared > 0 ? std::clamp(along / squared, 0.0, 1.0) : 0;
    const double x = d.x - at * way.x, y = d.y - at * way.y, reach = beside + d.radius;
    return std::ranges::any_of(posed.pieces(), [&](const geometry::PosedPiece& piece) {
      if (piece.low.z + std::min(0.0, way.z) - below > d.top) return false;
      if (x < piece.low.x - reach || x > piece.high.x + reach) return false;
      if (y < piece.low.y - reach || y > piece.high.y + reach) return false;
      Vec3d away;
      return piece.outside(x, y, away) <= reach;
    });
  }
};

double distance_to_way(const Vec3d& p, const Vec3d& from, const Vec3d& to) {
  const Vec3d way = to - from;
  const double squared = dot(way, way), at = squared > 0 ? std::clamp(dot(p - from, way) / squared, 0.0, 1.0) : 0;
  return length(p - from - at * way);
}

// Of the budget each edge leaves a quarter to those twice as long, which need a quarter of the triangles: however short
// it gets, there is some for coarser ground. `doubled`: how many times as long as wanted.
std::uint32_t share_of(std::uint32_t budget, int doubled) {
  return doubled < 15 ? budget - (budget >> 2 * (doubled + 1)) : budget;
}

// Halves faces of `faces`, and what comes of them, for as long as they are coarser than `wanted(face)`, m: not at all
// where that is infinite. False when `most` added vertices ended that.
template <class Wanted>
bool halve_faces(Ground& ground, double least, std::uint32_t most, std::vector<std::uint32_t>& faces,
                 Progress& progress, Wanted wanted) {
  state::Surface& surface = ground.surface;
  const auto squared = [&](std::uint32_t h) { return squared_length(surface, ground.soil, h); };
  while (!faces.empty()) {
    const std::uint32_t face = faces.back();
    const double longest = squared(longest_side(surface.mesh, face, squared));
    // The longest side of a right triangle with equal legs, and a little for rounding. What is wanted is asked last:
    // most faces are as fine as may be.
    const auto is_fine = [&](double edge) { return longest <= 2.002 * edge * edge; };
    if (is_fine(least) || is_fine(wanted(face))) {
      faces.pop_back();
      continue;
    }
    if (surface.bisection.added_count() >= most) return false;
    const std::uint32_t h = longest_ahead(surface.mesh, face, squared), before = surface.mesh.face_count();
    halve_edge(ground, h);
    ++progress.halved;
    for (std::uint32_t fresh = before; fresh < surface.mesh.face_count(); ++fresh) faces.push_back(fresh);
  }
  return true;
}

double fall_of(const Step& step) { return step.gravity * step.dt * step.dt; }

// Half of the width that a body presses; of one that has not touched yet, of what it may.
double patch_of(const state::Body& body, const geometry::PosedSolid& posed) {
  if (body.patch_width > 0) return body.patch_width;
  const Vec3d size = posed.high() - posed.low();
  return 0.25 * std::min(size.x, size.y);
}

// The ground that a body comes to in the next steps gets this edge, m, if `most` added vertices are enough.
bool refine_way(Ground& ground, const geometry::Bvh& bvh, state::Body& body, double edge, std::uint32_t most,
                const Step& step, Progress& progress, Scratch& scratch) {
  const double slack = kSlack * edge, speed = length(body.velocity);
  const double ahead = std::max(kAheadEdges * edge, kAheadSteps * speed * step.dt);
  const Vec3d way = speed > 1e-3 * edge ? (ahead / speed) * body.velocity : Vec3d{};
  scratch.posed.place(*body.solid, body.position, body.orientation, true);
  const double beside = slack + kBeside * edge + kBermWidth * patch_of(body, scratch.posed);
  const Reach reach{scratch.posed, way, beside, slack + edge + kAheadSteps * fall_of(step)};
  scratch.faces.clear();
  state::faces_near(ground.surface, bvh, reach.box(), scratch.faces);
  const bool whole = halve_faces(ground, edge, most, scratch.faces, progress, [&](std::uint32_t face) {
    return reach.meets(disc_of(ground.surface, face)) ? 0.0 : std::numeric_limits<double>::infinity();
  });
  body.refined_from = body.position, body.refined_to = body.position + way;
  body.refined_left = slack;
  return whole;
}

// True if the body has the edge it wants.
bool refine_for_body(Ground& ground, const geometry::Bvh& bvh, state::Body& body, const Limits& limits,
                     const Step& step, Progress& progress, Scratch& scratch) {
  body.refined_left -= geometry::sweep_speed(*body.solid, body.orientation, body.angular_velocity) * step.dt;
  const Vec3d next = body.position + step.dt * body.velocity;
  if (distance_to_way(next, body.refined_from, body.refined_to) + fall_of(step) >= body.refined_left) {
    body.spacing = body.edge;
    for (int doubled = 0;; body.spacing = std::ldexp(body.edge, ++doubled))
      if (refine_way(ground, bvh, body, body.spacing, share_of(limits.budget, doubled), step, progress, scratch)) break;
  }
  return body.spacing <= body.edge;
}

// True if the zone has the edge it wants.
bool refine_zone(Ground& ground, const geometry::Bvh& bvh, const Zone& zone, const Limits& limits, Progress& progress,
                 Scratch& scratch) {
  const auto end = static_cast<float>(kCraterEnd * zone.radius);
  math::Aabb around;
  around.include(Vec3{zone.centre.x - end, zone.centre.y - end, -math::Aabb::kInf});
  around.include(Vec3{zone.centre.x + end, zone.centre.y + end, math::Aabb::kInf});
  for (int doubled = 0;; ++doubled) {
    const double inside = std::ldexp(std::max(zone.edge, limits.edge), doubled);
    scratch.faces.clear();
    state::faces_near(ground.surface, bvh, around, scratch.faces);
    const auto wanted = [&](std::uint32_t face) {
      const Disc d = disc_of(ground.surface, face);
      const double r = (std::hypot(d.x - zone.centre.x, d.y - zone.centre.y) - d.radius) / zone.radius;
      return inside * std::max(1.0, 1 + kGrowth * (r - kRim));
    };
    if (halve_faces(ground, inside, share_of(limits.budget, doubled), scratch.faces, progress, wanted))
      return doubled == 0;
  }
}

bool is_near_body(const Ground& ground, std::uint32_t vertex, std::span<const state::Body> bodies) {
  const Vec3 p = ground.surface.position[vertex];
  return std::ranges::any_of(bodies, [&](const state::Body& body) {
    const double reach = 2 * body.radius + length(body.refined_to - body.refined_from) + 4 * kBeside * body.spacing;
    return std::abs(p.x - body.position.x) < reach && std::abs(p.y - body.position.y) < reach;
  });
}

// Of ground that a blast still works on, nothing goes.
bool is_in_blast(const Ground& ground, std::uint32_t vertex) {
  const Vec3 p = ground.surface.position[vertex];
  return std::ranges::any_of(ground.blasts, [&](const state::Blast& blast) {
    const double reach = kCraterEnd * blast.radius;
    return blast.active && std::abs(p.x - blast.ground_zero.x) < reach && std::abs(p.y - blast.ground_zero.y) < reach;
  });
}

// Did a vertex come where the body may touch it before it looks again what is near?
bool is_within_near(const Ground& ground, const state::Body& body, geometry::PosedSolid& posed) {
  const double reach = body.radius + body.near_left;
  bool placed = false;
  return std::ranges::any_of(ground.touched, [&](std::uint32_t vertex) {
    const Vec3 p = ground.surface.position[vertex];
    if (std::abs(p.x - body.position.x) >= reach || std::abs(p.y - body.position.y) >= reach) return false;
    if (!placed) posed.place(*body.solid, body.position, body.orientation, true);
    placed = true;
    return posed.within_reach(p, body.near_left);
  });
}

void forget(std::span<state::Body> bodies, std::uint32_t vertex) {
  for (state::Body& body : bodies) {
    if (body.last_vertex == vertex) body.last_vertex = kNone;
    if (std::binary_search(body.near.begin(), body.near.end(), vertex)) body.near_left = -1;
  }
}

void join_flat(Ground& ground, std::span<state::Body> bodies, const Limits& limits, Progress& progress) {
  state::Surface& surface = ground.surface;
  const std::uint32_t base = surface.bisection.base_vertex_count(), count = surface.mesh.vertex_count() - base;
  const double used = static_cast<double>(surface.bisection.added_count()) / std::max(1u, limits.budget);
  const double need = std::clamp((used - kPlenty) / (share_of(1024, 0) / 1024.0 - kPlenty), 0.0, 1.0);
  const auto tolerance = static_cast<float>(limits.tolerance * std::pow(kMostTolerance, need));
  const auto looks = static_cast<std::uint32_t>((kLeast + count / kShare) * (1 + need * (kMostLooks - 1)));
  for (std::uint32_t k = 0; k < std::min(count, looks); ++k) {
    if (progress.next >= count) progress.next = 0;
    const std::uint32_t vertex = base + progress.next++;
    if (!surface.bisection.can_merge(surface.mesh, vertex)) continue;
    const double bulge = bulge_at(ground, vertex, tolerance);
    if (bulge > tolerance && !(bulge <= limits.relief_share * relief_at(ground, vertex))) continue;
    if (!std::isfinite(bulge) || is_near_body(ground, vertex, bodies) || is_in_blast(ground, vertex)) continue;
    join_edge(ground, vertex);
    forget(bodies, vertex);
    ++progress.joined;
  }
}

}  // namespace

Outcome update(Ground& ground, const geometry::Bvh& bvh, std::span<state::Body> bodies, std::span<const Zone> zones,
               const Limits& limits, const Step& step, bool may_join, Progress& progress, Scratch& scratch) {
  const std::size_t rows = ground.particles.size();
  bool whole = true;
  for (state::Body& body : bodies) whole &= refine_for_body(ground, bvh, body, limits, step, progress, scratch);
  for (const Zone& zone : zones) whole &= refine_zone(ground, bvh, zone, limits, progress, scratch);
  for (state::Body& body : bodies)
    if (is_within_near(ground, body, scratch.posed)) body.near_left = -1;
  sort_rows(ground.particles, ground.soil);
  if (!whole) ++progress.short_steps;
  progress.most = std::max(progress.most, ground.surface.bisection.added_count());
  if (may_join) join_flat(ground, bodies, limits, progress);
  return {ground.particles.size() != rows, !whole};
}

}  // namespace divot::refine
