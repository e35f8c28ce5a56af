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
    const auto at = std::lower_bound(other->column.begin(), other->column.end(), vertex,
                                     [&](std::uint32_t c, std::uint32_t v) { return soil_.vertex[c] < v; });
    if (at != other->column.end() && *at == column)
      most += depth_of(*other, static_cast<std::size_t>(at - other->column.begin()));
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

void Company::join(Burst& burst, state::Blast& blast, double radius) const {
  const Vec3 place = blast.ground_zero;
  double yields = burst.yield, heights = burst.yield * burst.height, pulse = blast.pulse;
  Vec3 offsets;
  for (const state::Blast* other : others_) {
    const Vec3 offset = other->ground_zero - place;
    const double up = dot(offset, blast.direction);
    const double apart = std::sqrt(std::max(0.0, static_cast<double>(dot(offset, offset)) - up * up));
    const double share = laws::overlap(other->radius, radius, apart) * other->yield;
    if (share == 0) continue;
    yields += share, heights += share * other->height;
    offsets += static_cast<float>(share) * offset;
    pulse = std::max(pulse, other->pulse);
  }
  blast.ground_zero = place + static_cast<float>(1 / yields) * offsets;
  blast.pulse = pulse;  // what flows in both has one drag
  burst.yield = yields, burst.height = heights / yields;
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
}

}  // namespace divot::events
