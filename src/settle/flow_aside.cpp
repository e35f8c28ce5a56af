#include "settle/flow_aside.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "laws/bekker.h"
#include "laws/compaction.h"

namespace divot::settle {
namespace {

// Directions round a patch that are told apart.
constexpr int kSectors = 32;
// Radius, on the map that makes a patch's moments 1, at which an ellipse ends and soil counts as out.
constexpr double kRim = 2;
// Soil comes up beside the patch over this share of its size.
constexpr double kBermWidth = 0.5;

struct Flat {
  double x = 0, y = 0;
  friend Flat operator+(Flat a, Flat b) { return {a.x + b.x, a.y + b.y}; }
  friend Flat operator-(Flat a, Flat b) { return {a.x - b.x, a.y - b.y}; }
  friend Flat operator*(double s, Flat a) { return {s * a.x, s * a.y}; }
};
double dot(Flat a, Flat b) { return a.x * b.x + a.y * b.y; }
Flat unit(Flat a) {
  const double l = std::sqrt(dot(a, a));
  return l > 0 ? (1 / l) * a : Flat{};
}

Flat place_of(const Ground& ground, std::uint32_t vertex) {
  const Vec3 p = ground.surface.position[vertex];
  return {p.x, p.y};
}

// The ellipse with the patch's own moments, and the map that makes a circle of it.
struct Patch {
  Flat centre;
  double l11 = 1, l21 = 0, l22 = 1;  // Cholesky factor of the covariance

  Flat to_circle(Flat offset) const {
    const double x = offset.x / l11;
    return {x, (offset.y - l21 * x) / l22};
  }
  // Down the pressure under it, which falls from the centre to the edge: the short way out of a long patch.
  Flat downhill(Flat offset) const {
    const Flat w = to_circle(offset);
    const double y = w.y / l22;
    return unit({(w.x - l21 * y) / l11, y});
  }
  // How long the ellipse is in a direction.
  double length(Flat direction) const {
    return 2 * kRim * std::hypot(l11 * direction.x + l21 * direction.y, l22 * direction.y);
  }
  // Where round the patch a place lies or what leaves it in `direction` comes out, in sectors from 0 to kSectors.
  double side_of(Flat w) const {
    const double turn = std::atan2(w.y, w.x) / (2 * std::numbers::pi);
    return kSectors * (turn < 0 ? turn + 1 : turn);
  }
  double way_out(Flat offset, Flat direction) const {
    const Flat w = to_circle(offset), e = to_circle(direction);
    const double a = dot(e, e), b = dot(w, e), c = dot(w, w) - kRim * kRim;
    const double root = b * b - a * c;
    const double t = a > 0 && root > 0 ? std::max(0.0, (std::sqrt(root) - b) / a) : 0;
    return side_of(w + t * e);
  }
};

Patch patch_of(const Ground& ground, double spacing, std::span<const std::uint32_t> carried) {
  const auto area = [&](std::uint32_t i) { return static_cast<double>(ground.soil.area[ground.particles.column[i]]); };
  double total = 0;
  Flat sum;
  for (const std::uint32_t i : carried)
    total += area(i), sum = sum + area(i) * place_of(ground, ground.particles.vertex[i]);
  Patch patch{(1 / total) * sum};
  double xx = 0, xy = 0, yy = 0;
  for (const std::uint32_t i : carried) {
    const Flat r = place_of(ground, ground.particles.vertex[i]) - patch.centre;
    xx += area(i) * r.x * r.x, xy += area(i) * r.x * r.y, yy += area(i) * r.y * r.y;
  }
  // Every column is as wide as a spacing.
  const double own = spacing * spacing / 12;
  patch.l11 = std::sqrt(xx / total + own);
  patch.l21 = xy / total / patch.l11;
  patch.l22 = std::sqrt(std::max(own, yy / total + own - patch.l21 * patch.l21));
  return patch;
}

// Adds to volume[side] a share of each of the two sectors a side lies between.
struct Split {
  int low, high;
  double share;  // of the high one
};
Split split(double side) {
  const double at = std::floor(side);
  const int low = static_cast<int>(at) % kSectors;
  return {low, (low + 1) % kSectors, side - at};
}

using Sectors = std::array<double, kSectors>;

// Where a body's underside moves sideways over the ground, what it comes down explains only a part of the sinkage of a
// column: the share of the rest.
double pushed_share(const state::Body& body, const state::Particles& p, std::uint32_t i, double dt, Vec3d& moves) {
  // In the middle of the step, where what rolls came down as much as the column has sunk, and by as much as the body
  // did come down in it: what falls has lost most of its speed at the end.
  const Vec3d arm = to_double(p.position(i)) - (body.position - 0.5 * body.way);
  moves = Vec3d{body.velocity.x, body.velocity.y, body.way.z / dt} + cross(body.angular_velocity, arm);
  return 1 - std::min(1.0, std::max(0.0, -moves.z) * dt / p.yielded[i]);
}

// How far ahead lies what a body pushes on, m: a heap as high as what it pushed in this step, at its angle of repose.
double heap_length(const state::Body& body, std::span<const std::uint32_t> carried, std::span<const laws::Medium> media,
                   double dt, const state::Particles& p) {
  double most = 0;
  Vec3d moves;
  for (const std::uint32_t i : carried)
    if (p.yielded[i] > 0)
      most = std::max(most, pushed_share(body, p, i, dt, moves) * p.yielded[i] / media[p.material[i]].tan_repose);
  return most;
}

// What flows out from under the body by the side on which it comes out, m^3. Books of the columns it leaves are kept.
double squeeze_out(const state::Body& body, const Patch& patch, std::span<const std::uint32_t> carried,
                   std::span<const laws::Medium> media, const Step& step, Ground& ground, Sectors& volume) {
  const state::Particles& p = ground.particles;
  state::Soil& soil = ground.soil;
  double total = 0;
  const double going = std::hypot(body.velocity.x, body.velocity.y), speed_of_body = length(body.velocity);
  const double rolls = speed_of_body > 0 ? std::sqrt(going / speed_of_body) : 0;
  const Flat along = rolls * unit({body.velocity.x, body.velocity.y});
  // What leaves abeam does so over the way of this step: all of it in the middle would lie in heaps, a step's way
  // apart, and slide back.
  const double length_along = patch.length(unit({body.velocity.x, body.velocity.y}));
  const double gathered = going > 0 ? 1 - std::min(1.0, going * step.dt / length_along) : 1;
  for (const std::uint32_t i : carried) {
    if (p.yielded[i] <= 0) continue;
    const std::uint32_t column = p.column[i];
    const laws::Medium& medium = media[p.material[i]];
    // The soil has failed where Bekker's curve has passed what it bears.
    const double pressed = laws::bekker_pressure<double>(medium, soil.plastic[column], body.patch_width);
    if (pressed < laws::bearing_capacity(medium, body.patch_width, step.gravity)) continue;
    Vec3d moves;
    const double pushed = pushed_share(body, p, i, step.dt, moves);

    const double area = soil.area[column], elastic = std::max(0.0f, soil.rest[column].z - p.z[i]);
    const double lost = soil.compacted[column] / area - elastic;
    const double limit = medium.compaction_limit * laws::kPressureBulb * body.patch_width * (1 - pushed);
    const double closed = laws::closed_pores(p.yielded[i], lost - p.yielded[i], limit);
    const double flows = std::clamp(p.yielded[i] - closed, 0.0, std::max(0.0, lost)) * area;
    if (flows <= 0) continue;

    // Soil laid down before a body that rolls on would only be rolled over again: it leaves abeam.
    const Flat offset = place_of(ground, p.vertex[i]) - patch.centre;
    const Flat down = patch.downhill(offset), from = offset - (1 - pushed) * gathered * dot(offset, along) * along;
    const Flat direction = (1 - pushed) * unit(down - dot(down, along) * along) + pushed * unit({moves.x, moves.y});
    const auto [low, high, share] = split(patch.way_out(from, direction));
    volume[low] += (1 - share) * flows, volume[high] += share * flows;
    soil.gained[column] -= flows;
    soil.compacted[column] -= flows;
    total += flows;
  }
  return total;
}

bool is_free(const Ground& ground, std::uint32_t vertex) {
  const std::uint32_t column = ground.surface.column[vertex];
  const std::uint32_t i = column == kNone ? kNone : ground.soil.particle[column];
  return i == kNone || (ground.particles.hold[i] != Hold::carried && ground.particles.flow_rate[i] == 0);
}

// Free vertices within `reach` of what the body presses, and at least the first ring of them, ring by ring.
void find_beside(const Ground& ground, std::span<const std::uint32_t> carried, double reach, FlowScratch& scratch) {
  using Beside = FlowScratch::Beside;
  auto &ring = scratch.ring, &next = scratch.next;
  scratch.beside.clear(), ring.clear();
  for (const std::uint32_t i : carried) {
    const Flat place = place_of(ground, ground.particles.vertex[i]);
    ring.push_back({.vertex = ground.particles.vertex[i], .x = place.x, .y = place.y});
    scratch.met.insert(ground.particles.vertex[i]);
  }
  while (!ring.empty()) {
    next.clear();
    for (const Beside& from : ring)
      ground.surface.mesh.for_each_neighbour(from.vertex, [&](std::uint32_t u) {
        if (scratch.met.contains(u) || !is_free(ground, u)) return;
        const Flat here = place_of(ground, from.vertex), edge = place_of(ground, u) - here;
        const double distance = from.distance + std::sqrt(dot(edge, edge));
        if (distance >= reach) return;
        const Flat rim = from.distance > 0 ? Flat{from.x, from.y} : here + 0.5 * edge;
        next.push_back({.vertex = u, .distance = distance, .x = rim.x, .y = rim.y});
      });
    std::sort(next.begin(), next.end(), [](const Beside& a, const Beside& b) {
      return a.vertex != b.vertex ? a.vertex < b.vertex : a.distance < b.distance;
    });
    next.erase(std::unique(next.begin(), next.end(), [](auto& a, auto& b) { return a.vertex == b.vertex; }),
               next.end());
    for (const Beside& b : next) scratch.met.insert(b.vertex);
    scratch.beside.insert(scratch.beside.end(), next.begin(), next.end());
    std::swap(ring, next);
  }
  scratch.met.clear();
}

// Soil that comes out where nothing can take it, as at the terrain's border, goes on round the patch.
void move_to_open_sides(const Sectors& room, Sectors& volume) {
  const Sectors from = volume;
  for (int s = 0; s < kSectors; ++s) {
    if (room[s] > 0 || from[s] == 0) continue;
    volume[s] = 0;
    for (int away = 1; away <= kSectors / 2; ++away) {
      const int left = (s + away) % kSectors, right = (s + kSectors - away) % kSectors;
      const double open = (room[left] > 0) + (room[right] > 0);
      if (open == 0) continue;
      if (room[left] > 0) volume[left] += from[s] / open;
      if (room[right] > 0) volume[right] += from[s] / open;
      break;
    }
  }
}

float lay_beside(Ground& ground, const Sectors& room, const Sectors& volume, const FlowScratch& scratch) {
  float highest = 0;
  for (const FlowScratch::Beside& b : scratch.beside) {
    const auto [low, high, share] = split(b.side);
    double comes = 0;
    if (room[low] > 0) comes += volume[low] * (1 - share) * b.weight / room[low];
    if (room[high] > 0) comes += volume[high] * share * b.weight / room[high];
    if (comes <= 0) continue;
    const std::uint32_t column = state::touch_column(ground.surface, ground.soil, b.vertex);
    highest = std::max(highest, bring(ground, column, comes, b.area));
  }
  return highest;
}

void flow_from_under(const state::Body& body, std::span<const std::uint32_t> carried,
                     std::span<const laws::Medium> media, const Step& step, Ground& ground, FlowScratch& scratch) {
  const Patch patch = patch_of(ground, body.spacing, carried);
  const double slope = kBermWidth * body.patch_width + 1.5 * body.spacing;
  const double heap = heap_length(body, carried, media, step.dt, ground.particles);
  find_beside(ground, carried, slope + heap, scratch);
  const Flat going = unit({body.velocity.x, body.velocity.y});
  Sectors room{}, volume{};
  for (FlowScratch::Beside& b : scratch.beside) {
    // Ahead over the whole heap, which goes on as it is; elsewhere next to the patch.
    const double ahead = std::max(0.0, dot(unit(place_of(ground, b.vertex) - Flat{b.x, b.y}), going));
    const double share_here = std::clamp((slope + ahead * heap - b.distance) / slope, 0.0, 1.0);
    b.area = state::vertex_area(ground.surface, b.vertex);
    b.weight = b.area * share_here;
    b.side = patch.side_of(patch.to_circle(Flat{b.x, b.y} - patch.centre));
    const auto [low, high, share] = split(b.side);
    room[low] += (1 - share) * b.weight, room[high] += share * b.weight;
  }
  if (std::all_of(room.begin(), room.end(), [](double r) { return r <= 0; })) return;
  if (squeeze_out(body, patch, carried, media, step, ground, volume) <= 0) return;
  move_to_open_sides(room, volume);
  const float rose = lay_beside(ground, room, volume, scratch);
  ground.moved.distance += rose, ground.moved.free_distance += rose;
}

// Lists carried particles by body.
void sort_by_body(const state::Particles& p, std::size_t body_count, FlowScratch& scratch) {
  scratch.first.assign(body_count + 1, 0);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.hold[i] == Hold::carried) ++scratch.first[p.carrier[i] + 1];
  for (std::size_t b = 0; b < body_count; ++b) scratch.first[b + 1] += scratch.first[b];
  scratch.carried.resize(scratch.first[body_count]);
  for (std::size_t i = p.size(); i-- > 0;)
    if (p.hold[i] == Hold::carried) scratch.carried[--scratch.first[p.carrier[i] + 1]] = static_cast<std::uint32_t>(i);
  // Each start was counted down to that of its own list, one place too far along.
  scratch.first.erase(scratch.first.begin());
  scratch.first.push_back(static_cast<std::uint32_t>(scratch.carried.size()));
}

}  // namespace

void flow_aside(std::span<const state::Body> bodies, std::span<const laws::Medium> media, const Step& step,
                Ground& ground, FlowScratch& scratch) {
  if (bodies.empty()) return;
  sort_by_body(ground.particles, bodies.size(), scratch);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const std::span carried(scratch.carried.begin() + scratch.first[b], scratch.carried.begin() + scratch.first[b + 1]);
    const bool yields =
        std::any_of(carried.begin(), carried.end(), [&](std::uint32_t i) { return ground.particles.yielded[i] > 0; });
    if (yields) flow_from_under(bodies[b], carried, media, step, ground, scratch);
  }
}

}  // namespace divot::settle
