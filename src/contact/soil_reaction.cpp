#include "contact/soil_reaction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "contact/balance.h"
#include "contact/frozen_columns.h"
#include "contact/near.h"
#include "contact/rim_shear.h"

namespace divot::contact {
namespace {

// A body that starts at rest on the ground is set down in this time, s: its weight comes onto the soil bit by bit. All
// of it at once makes a heavy ball sink half as deep again as Bekker's pressure carries it; half the time still a
// quarter. It comes and ends smoothly: one that grew evenly would still be going down when it is all there. What lowers
// it slows it down at a rate of kLowering, 1/s, and lets go once it goes down by no more than kLowered, m/s.
constexpr double kSetDown = 1.5, kLowering = 8, kLowered = 0.01;

// An impact is met in parts of the step, in each of which the soil takes at most this share of the speed: the balance
// at the end of a longer one would stop a body before it is where the soil can. Parts are no shorter than 1/kMostParts.
constexpr double kMostTaken = 0.025;
constexpr int kMostParts = 64;
constexpr int kMostPasses = 3;
// A second pass is the last where the first one finds that loads have changed by no more than this share since the last
// step: what rolls through soft soil needs no third, what has a few stiff columns below it does.
constexpr double kSameLoad = 0.1;
// Shares of the spacing by which Newton's last step in a pass may move the body.
constexpr double kRough = 1e-5, kExact = 1e-8;

using math::add_scaled;
using math::Matrix6;

// Newton's law of impact on top of the soil's plastic answer: once the soil has stopped the body, the share of the
// speed of impact that restitution asks for comes back. Soil alone would return next to nothing.
// True when it did.
bool rebound(state::Body& body, const std::vector<Footing>& footings, const Columns& columns, const Row& v,
             const Vec3d& before, const Situation& s) {
  body.velocity = {v[0], v[1], v[2]};
  body.angular_velocity = {v[3], v[4], v[5]};
  Vec3d sum;
  double most = 0;
  std::uint8_t material = 0;
  for (std::size_t k = 0; k < footings.size() && columns.any_below; ++k) {
    const ColumnBlock& b = columns.blocks[k / ColumnBlock::kColumns];
    const std::size_t i = k % ColumnBlock::kColumns;
    const double load = b.load[i];
    sum += load * Vec3d{b.rise[0][i], b.rise[1][i], 1};
    if (load > most) most = load, material = footings[k].material;
  }
  if (most <= 0) return false;
  const Vec3d up = sum * (1 / length(sum));
  const double resting = 2 * length(s.gravity) * s.dt;  // what gravity alone brings is no impact
  const double approach = -dot(before, up);
  if (!body.touching && approach > resting) body.impact_speed = std::max(body.impact_speed, approach);
  const double leaving = dot(body.velocity, up);
  if (body.impact_speed == 0 || leaving < -0.02 * body.impact_speed) return false;
  const double wanted = body.restitution * s.media[material].restitution * body.impact_speed;
  const bool bounces = wanted > std::max(leaving, resting);
  if (bounces) body.velocity += (wanted - leaving) * up;
  body.impact_speed = 0;
  return bounces;
}

// The patch of ground that a body touches.
struct Patch {
  double area = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;  // m^2 times lengths

  void add(double px, double py, double cell) {
    area += cell, x += cell * px, y += cell * py;
    const double own = cell / 12;  // of a square about its middle, by area
    xx += cell * (px * px + own), yy += cell * (py * py + own), xy += cell * px * py;
  }

  // Bekker's b, m: the radius of a round patch, the smaller side of the rectangle that spreads like any other.
  double width(bool round) const {
    if (area <= 0) return 0;
    if (round) return std::sqrt(area / std::numbers::pi);
    const double a = xx - x * x / area, b = yy - y * y / area, c = xy - x * y / area;
    const double middle = 0.5 * (a + b), spread = std::hypot(0.5 * (a - b), c);
    return std::sqrt(area * std::sqrt(std::max(0.0, middle - spread) / (middle + spread)));
  }
};

// Balls do, and what stands on a round end.
bool touches_roundly(const state::Body& body) {
  if (body.solid->pieces.size() != 1) return false;
  const geometry::Piece& piece = body.solid->pieces[0];
  using Kind = geometry::Piece::Kind;
  if (piece.kind == Kind::sphere) return true;
  if (piece.kind == Kind::box || piece.kind == Kind::hull) return false;
  const math::Matrix3 axes = math::matrix_of(math::operator*(body.orientation, piece.rotation));
  constexpr double kUpright = 0.7;
  return std::abs(piece.kind == Kind::cone ? axes[2].z : axes[2].y) > kUpright;
}

// The share of its weight that a body has, from 0 to 1: less than all of it while it is set down. Then it is slowed on
// its way into the ground.
double set_down(state::Body& body, const Vec3d& ground, double dt) {
  if (body.weight_share < 1) {
    const Vec3d up = ground * (1 / length(ground));
    const double sinking = body.touching ? std::max(0.0, -dot(body.velocity, up)) : 0;
    body.velocity += sinking * (1 - 1 / (1 + kLowering * dt)) * up;
    // All but let go, until it rests.
    body.weight_share =
        std::min(sinking > kLowered ? std::nextafter(1.0, 0.0) : 1.0, body.weight_share + dt / kSetDown);
  }
  return body.weight_share * body.weight_share * (3 - 2 * body.weight_share);
}

void keep_loads(const Columns& columns, std::vector<double>& loads) {
  loads.clear();
  for (const ColumnBlock& b : columns.blocks) loads.insert(loads.end(), b.load, b.load + ColumnBlock::kColumns);
}

// Sum of how much each load has changed, over that of all loads.
double load_change(const Columns& columns, const std::vector<double>& before) {
  double change = 0, sum = 0;
  auto old = before.begin();
  for (const ColumnBlock& b : columns.blocks)
    for (const double load : b.load) change += std::abs(load - *old++), sum += load;
  return sum > 0 ? change / sum : 0;
}

// The velocity at which the body is in balance with the soil after s.dt. `weight`: share of gravity.
Row find_velocity(const state::Body& body, double weight, const Situation& s, Scratch::PerBody& scratch,
                  Resistance& resistance) {
  Columns& columns = scratch.columns;
  ColumnTask& task = scratch.task;
  const ColumnKernel& kernel = fastest_columns();
  columns.any_below = false;
  resistance = {inertia_of(body), body.held_impulse};
  Row start = math::row(body.velocity + s.dt * weight * s.gravity, body.angular_velocity);
  if (body.held_impulse != Row{}) {
    Matrix6 inertia = resistance.whole;
    Row change = body.held_impulse;
    solve(inertia, change);
    add_scaled(start, change, 1);
  }
  // Without the soil, weight or what carries a chassis would press a body that rolls deeper into the ground: the
  // velocity it has is nearer to the one it will have, and with it the geometry.
  const bool rolls = body.touching || body.held_impulse != Row{};
  Row v = rolls ? math::row(body.velocity, body.angular_velocity) : start;
  if (scratch.footings.empty()) return start;
  fill_columns(body, s, scratch);
  Balance balance{body, columns.blocks, task, scratch.walls, s, start, resistance.whole, scratch.guides};
  // Grip comes from the load of the pass before, and first from that of the last step.
  for (int pass = 0, passes = kMostPasses; pass < passes; ++pass) {
    freeze_geometry(body, {body.position, body.orientation}, v, s, scratch);
    if (!columns.any_below) {
      resistance.whole = balance.inertia;
      return start;
    }
    if (pass == 0) limit_to_rim(v, s.dt, scratch.footings, columns);
    // What the next pass starts from need not be exact.
    resistance.whole = find_balance(balance, (pass + 1 < passes ? kRough : kExact) * body.spacing, v);
    std::copy(v.begin(), v.end(), task.v);
    if (pass == 0) keep_loads(columns, scratch.loads);
    kernel.load(task, columns.blocks.data(), columns.blocks.size());
    if (pass == 0 && load_change(columns, scratch.loads) <= kSameLoad) passes = 2;
  }
  kernel.end(task, columns.blocks.data(), columns.blocks.size());
  if (balance.guides.empty()) return v;
  // What resists joints is without what stands in for them.
  for (const Guide& guide : balance.guides)
    add_scaled(resistance.steady, guide.line, balance.weight_of(guide) * (guide.speed - dot6(guide.line, v)));
  balance.guides = {};
  balance.missing(v, &resistance.whole);
  return v;
}

// Columns with the load that the body had on them in the last step. What shear held of it starts from nothing: grip is
// that of a load which carries all of the body. With that of what is left wheels would pull a tenth less, too little in
// mud.
void start_columns(Scratch::PerBody& scratch) {
  constexpr std::size_t kFour = ColumnBlock::kColumns;
  std::vector<ColumnBlock>& blocks = scratch.columns.blocks;
  blocks.assign((scratch.footings.size() + kFour - 1) / kFour, {});
  auto press = scratch.presses.begin();
  for (std::size_t k = 0; k < scratch.footings.size(); ++k) {
    const std::uint32_t vertex = scratch.footings[k].vertex;
    while (press != scratch.presses.end() && press->vertex < vertex) ++press;
    if (press == scratch.presses.end() || press->vertex != vertex) continue;
    blocks[k / kFour].load[k % kFour] = press->load;
  }
}

// Whether the soil takes so much of the speed that the step is too long to see where. Bodies that others or joints hold
// are met in one part: those know only whole steps.
bool is_impact(const state::Body& body, const Row& v, double weight, const Situation& s,
               const Scratch::PerBody& scratch, double speed) {
  if (!scratch.columns.any_below || !scratch.guides.empty() || body.held_impulse != Row{}) return false;
  if (speed < length(s.gravity) * s.dt) return false;
  const double taken = length(math::linear(v) - body.velocity - s.dt * weight * s.gravity);
  return taken > kMostTaken * speed + length(s.gravity) * s.dt;  // what it takes of gravity is no impact
}

// The body moves on by a part of the step, and the soil remembers what it did.
void move_part(state::Body& body, const Situation& s, Scratch::PerBody& scratch) {
  body.position += s.dt * body.velocity;
  body.orientation = math::spun(body.orientation, body.angular_velocity, s.dt);
  scratch.end.place(*body.solid, body.position, body.orientation);
  Patch patch;
  const Columns& columns = scratch.columns;
  for (std::size_t k = 0; k < scratch.footings.size() && columns.any_below; ++k) {
    Footing& f = scratch.footings[k];
    const geometry::Underside under = scratch.end.underside(f.x, f.y);
    if (!under.below || under.height >= f.height || !columns.is_below(k)) continue;
    patch.add(f.arm_x - body.position.x, f.arm_y - body.position.y, f.area);
    f.plastic = columns.at(&ColumnBlock::end_plastic, k), f.shear = columns.at(&ColumnBlock::end_shear, k);
    const double elastic = columns.at(&ColumnBlock::end_pressure, k) / s.media[f.material].elastic_stiffness;
    f.fresh -= std::max(0.0, f.fresh - under.height - f.plastic - elastic);
    f.height = under.height, f.carried = true;
    body.touching = true;
  }
  body.patch_width = patch.width(touches_roundly(body));
}

}  // namespace

void meet_soil(state::Body& body, const Situation& s, Scratch::PerBody& scratch, Resistance& resistance) {
  const double weight = set_down(body, scratch.ground, s.dt), speed = length(body.velocity);
  const Scratch::Pose before{body.position, body.orientation};
  Situation part = s;
  Row way{};
  scratch.at_start.clear();
  start_columns(scratch);
  for (double left = s.dt;;) {
    const Row v = find_velocity(body, weight, part, scratch, resistance);
    if (part.dt > s.dt / kMostParts && is_impact(body, v, weight, part, scratch, speed)) {
      part.dt = 0.5 * part.dt;
      continue;
    }
    // A body that bounces leaves the soil: joints must not be held against it.
    const Vec3d arrived = body.velocity;
    if (rebound(body, scratch.footings, scratch.columns, v, arrived, part)) resistance.whole = inertia_of(body);
    left -= part.dt;
    add_scaled(way, math::row(body.velocity, body.angular_velocity), part.dt);
    if (left <= 0) break;
    if (scratch.at_start.empty())
      for (const Footing& f : scratch.footings) scratch.at_start.push_back({f.height, f.shear});
    move_part(body, part, scratch);
  }
  scratch.gain = {};
  if (scratch.at_start.empty()) return;
  // Over the whole step the body goes at its mean velocity, and has its last one then.
  for (std::size_t k = 0; k < scratch.footings.size(); ++k)
    scratch.footings[k].height = scratch.at_start[k].height, scratch.footings[k].shear = scratch.at_start[k].shear;
  body.position = before.position, body.orientation = before.orientation;
  const Row last = math::row(body.velocity, body.angular_velocity);
  body.velocity = math::linear(way) * (1 / s.dt), body.angular_velocity = math::angular(way) * (1 / s.dt);
  scratch.gain = moved(last, math::row(body.velocity, body.angular_velocity), -1);
}

void answer_again(const state::Body& body, const Scratch::Pose& before, const Situation& s, Scratch::PerBody& scratch) {
  if (scratch.footings.empty()) return;
  fill_columns(body, s, scratch);
  freeze_geometry(body, before, math::row(body.velocity, body.angular_velocity), s, scratch);
  fastest_columns().end(scratch.task, scratch.columns.blocks.data(), scratch.columns.blocks.size());
}

void record_presses(state::Body& body, Scratch::PerBody& scratch) {
  scratch.presses.clear();
  body.sinkage = 0;
  body.last_vertex = kNone;
  double deepest = 0;
  Patch patch;
  const Columns& columns = scratch.columns;
  if (columns.any_below) scratch.end.place(*body.solid, body.position, body.orientation);
  for (std::size_t k = 0; k < scratch.footings.size() && columns.any_below; ++k) {
    const Footing& f = scratch.footings[k];
    const geometry::Underside under = scratch.end.underside(f.x, f.y);
    if (!under.below || under.height >= f.height || !columns.is_below(k)) continue;
    const Vec3d shear = columns.at(&ColumnBlock::end_shear, k), slid = shear - f.shear;
    const Vec3 place = f.vertex_position + to_float({slid.x, slid.y, 0});
    scratch.presses.push_back({f.vertex,
                               {place.x, place.y, static_cast<float>(under.height - f.above_vertex)},
                               to_float(shear),
                               static_cast<float>(columns.at(&ColumnBlock::end_plastic, k)),
                               static_cast<float>(columns.at(&ColumnBlock::end_pressure, k)),
                               static_cast<float>(columns.at(&ColumnBlock::load, k))});
    patch.add(f.arm_x - body.position.x, f.arm_y - body.position.y, f.area);
    const double sunk = f.original - under.height;
    body.sinkage = std::max(body.sinkage, sunk);
    if (body.last_vertex == kNone || sunk > deepest) deepest = sunk, body.last_vertex = f.vertex;
  }
  body.touching = !scratch.presses.empty();
  body.patch_width = patch.width(touches_roundly(body));
  body.max_sinkage = std::max(body.max_sinkage, body.sinkage);
}

}  // namespace divot::contact
