#include "events/together.h"

#include <algorithm>
#include <cmath>

#include "laws/crater.h"

namespace divot::events {
namespace {

// Only the scaled model makes ground flow.
bool still_digs(const state::Blast& blast) { return blast.active && blast.radius > 0 && blast.flow_rate > 0; }

// A push falling to 0 over the time P against a relaxation time 2 P ends push P^2 deep.
double depth_of(const state::Blast& blast, std::size_t k) {
  return static_cast<double>(blast.push[k]) * blast.pulse * blast.pulse;
}

// Place of a vertex's column in a list that ascends by vertex, kNone where it is not in it.
std::uint32_t place_of(const std::vector<std::uint32_t>& columns, std::uint32_t vertex, const state::Soil& soil) {
  const auto at = std::lower_bound(columns.begin(), columns.end(), vertex,
                                   [&](std::uint32_t c, std::uint32_t v) { return soil.vertex[c] < v; });
  return at != columns.end() && soil.vertex[*at] == vertex ? static_cast<std::uint32_t>(at - columns.begin()) : kNone;
}

// Calls with the places of the columns that two ascending lists have in common.
template <class Call>
void for_common(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b, const state::Soil& soil,
                const Call& call) {
  for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
    if (a[i] == b[k])
      call(i++, k++);
    else
      soil.vertex[a[i]] < soil.vertex[b[k]] ? ++i : ++k;
  }
}

bool meet(const state::Blast& a, const state::Blast& b, const state::Soil& soil) {
  bool common = false;
  for_common(a.column, b.column, soil, [&](std::size_t, std::size_t) { common = true; });
  return common;
}

// Nothing lands on ground that the other blast digs; the rest lies the higher.
void land_beside(state::Blast& blast, const state::Blast& other, const state::Soil& soil) {
  for_common(blast.landing, other.column, soil, [&](std::size_t i, std::size_t) { blast.landing_height[i] = 0; });
  double all = 0;
  for (std::size_t i = 0; i < blast.landing.size(); ++i)
    all += static_cast<double>(blast.landing_height[i]) * soil.area[blast.landing[i]];
  if (all <= 0) blast.landing.clear(), blast.landing_height.clear();
  for (float& height : blast.landing_height) height = static_cast<float>(height / all);
}

}  // namespace

Company::Company(const state::Blast& blast, std::span<const state::Blast> earlier, const state::Surface& surface,
                 const state::Soil& soil)
    : blast_(blast), surface_(surface), soil_(soil) {
  for (const state::Blast& other : earlier)
    if (still_digs(other)) others_.push_back(&other);
}

double Company::sunk(std::uint32_t vertex) const {
  const std::uint32_t column = surface_.column[vertex];
  if (column == kNone) return 0;
  const Vec3 way = surface_.position[vertex] - soil_.original[column];
  double most = 0;
  for (const state::Blast* other : others_) {
    if (other->start == blast_.start) continue;  // nothing moved yet
    if (const std::uint32_t at = place_of(other->column, vertex, soil_); at != kNone) most += depth_of(*other, at);
  }
  return std::clamp(static_cast<double>(dot(way, blast_.direction)), 0.0, most);
}

double Company::ground_zero_sunk() const {
  std::uint32_t nearest = kNone;
  float least = surface_.spacing * surface_.spacing;
  for (const state::Blast* other : others_) {
    for (const std::uint32_t column : other->column) {
      const Vec3 offset = surface_.position[soil_.vertex[column]] - blast_.ground_zero;
      const float squared = offset.x * offset.x + offset.y * offset.y;
      if (squared < least) least = squared, nearest = soil_.vertex[column];
    }
  }
  return nearest == kNone ? 0 : sunk(nearest);
}

double Company::raised(std::uint32_t vertex) const {
  const std::uint32_t column = surface_.column[vertex];
  if (column == kNone) return 0;
  const bool landed = std::any_of(others_.begin(), others_.end(), [&](const state::Blast* other) {
    const auto at = place_of(other->landing, vertex, soil_);
    return other->start < blast_.start && at != kNone && other->landing_height[at] > 0;
  });
  const Vec3 way = surface_.position[vertex] - soil_.original[column];
  return landed ? std::max(0.0, -static_cast<double>(dot(way, blast_.direction))) : 0;
}

double Company::share(const state::Blast& other, const Charge& own, double radius) const {
  const Vec3 offset = other.ground_zero - own.blast.ground_zero;
  const double up = dot(offset, own.blast.direction);
  const double apart = std::sqrt(std::max(0.0, static_cast<double>(dot(offset, offset)) - up * up));
  const double common = laws::overlap(other.radius, radius, apart);
  return common * (2 - common);
}

std::vector<Charge> Company::diggers(const Charge& own, double radius) const {
  std::vector<Charge> charges = {own};
  Charge all = own;
  double yields = 0, heights = 0, most = 0;
  Vec3 offsets;
  for (const state::Blast* other : others_) {
    const double part = share(*other, own, radius), counts = part * other->yield;
    yields += counts, heights += counts * other->height;
    offsets += static_cast<float>(counts) * (other->ground_zero - own.blast.ground_zero);
    if (part > 0) all.blast.pulse = std::max(all.blast.pulse, other->pulse);
    most = std::max(most, part);
  }
  if (most == 0) return charges;
  yields += most * own.burst.yield, heights += most * own.burst.yield * own.burst.height;
  all.blast.ground_zero += static_cast<float>(1 / yields) * offsets;
  all.burst.yield = yields, all.burst.height = heights / yields;
  charges.push_back(all);
  return charges;
}

std::vector<Charge> Company::at_once(const Charge& own, double radius) const {
  std::vector<Charge> charges;
  for (const state::Blast* other : others_)
    if (other->start == own.blast.start && share(*other, own, radius) > 0)
      charges.push_back({{other->yield, other->height, own.burst.gravity}, *other});
  return charges;
}

void share_ground(state::Blast& blast, std::span<state::Blast> earlier, const state::Soil& soil) {
  const double to_push = 1 / (blast.pulse * blast.pulse);
  for (state::Blast& other : earlier) {
    if (!still_digs(other)) continue;
    for_common(blast.column, other.column, soil, [&](std::size_t i, std::size_t k) {
      const double left = static_cast<double>(blast.push[i]) - depth_of(other, k) * to_push;
      blast.push[i] = static_cast<float>(std::max(0.0, left));
      other.thrown[k] = 0;
    });
    land_beside(other, blast, soil);
    land_beside(blast, other, soil);
  }
  for (state::Blast& other : earlier)
    if (still_digs(other) && other.start == blast.start && meet(blast, other, soil))
      other.landing = blast.landing, other.landing_height = blast.landing_height;
}

}  // namespace divot::events
