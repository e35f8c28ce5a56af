#include "activation/activation.h"

#include <algorithm>

namespace divot::activation {
namespace {

bool is_awake(const state::Particles& p, const state::Soil& soil, const state::Surface& surface, std::uint32_t vertex) {
  const std::uint32_t column = surface.column[vertex];
  if (column == kNone || soil.particle[column] == kNone) return false;
  const Hold hold = p.hold[soil.particle[column]];
  return hold == Hold::free || hold == Hold::carried;
}

// Who is awake after this step, ascending; false if that is who was.
bool list_awake(const state::Particles& p, const state::Soil& soil, const state::Surface& surface,
                std::vector<std::uint32_t>& wake, std::vector<std::uint32_t>& awake, std::vector<std::uint32_t>& merged,
                core::IdSet& set) {
  set.sort_unique(wake);
  std::erase_if(wake, [&](std::uint32_t v) { return is_awake(p, soil, surface, v); });
  // Counting looks at all of them, but many at a time; a search that stops would not.
  const bool slept = std::count(p.hold.begin(), p.hold.end(), Hold::asleep) > 0;
  if (wake.empty() && !slept) return false;
  awake.clear();
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.hold[i] == Hold::free || p.hold[i] == Hold::carried) awake.push_back(p.vertex[i]);
  // Not std::inplace_merge, which allocates.
  merged.resize(awake.size() + wake.size());
  std::merge(awake.begin(), awake.end(), wake.begin(), wake.end(), merged.begin());
  awake.swap(merged);
  return true;
}

// Neighbours of the awake that are not awake themselves, ascending.
void list_anchors(const state::Surface& surface, const std::vector<std::uint32_t>& awake,
                  std::vector<std::uint32_t>& anchors, core::IdSet& set) {
  for (const std::uint32_t v : awake) surface.mesh.for_each_neighbour(v, [&](std::uint32_t u) { set.insert(u); });
  for (const std::uint32_t v : awake) set.erase(v);
  set.drain(anchors);
}

// Appends the row of a vertex: as it was, or fresh from the surface.
void append_row(state::Particles& to, const state::Particles& from, const state::Surface& surface,
                const state::Soil& soil, std::span<const laws::Medium> media, std::uint32_t vertex, bool anchor) {
  const std::uint32_t column = surface.column[vertex], old = soil.particle[column];
  const Vec3 position = old != kNone ? from.position(old) : surface.position[vertex];
  const bool moves_on = !anchor && is_awake(from, soil, surface, vertex);
  const Vec3 velocity = moves_on ? from.velocity(old) : Vec3{};
  to.vertex.push_back(vertex), to.column.push_back(column);
  to.x.push_back(position.x), to.y.push_back(position.y), to.z.push_back(position.z);
  to.vx.push_back(velocity.x), to.vy.push_back(velocity.y), to.vz.push_back(velocity.z);
  for (auto* force : {&to.fx, &to.fy, &to.fz}) force->push_back(0);
  to.material.push_back(surface.material[vertex]);
  to.mass.push_back(media[surface.material[vertex]].areal_mass * soil.cell[column]);
  to.flow_rate.push_back(moves_on ? from.flow_rate[old] : 0);
  to.held_pull.push_back(moves_on ? from.held_pull[old] : 0);
  to.yielded.push_back(0);
  to.carrier.push_back(moves_on ? from.carrier[old] : kNone);
  to.hold.push_back(anchor ? Hold::anchor : moves_on && from.hold[old] == Hold::carried ? Hold::carried : Hold::free);
  to.still_steps.push_back(moves_on ? from.still_steps[old] : 0);
}

}  // namespace

bool update(state::Particles& particles, state::Soil& soil, state::Surface& surface,
            std::span<const laws::Medium> media, std::vector<std::uint32_t>& wake, Scratch& scratch) {
  const bool changed = list_awake(particles, soil, surface, wake, scratch.awake, scratch.anchors, scratch.set);
  wake.clear();
  if (!changed) return false;
  list_anchors(surface, scratch.awake, scratch.anchors, scratch.set);

  scratch.next.for_each_array([](auto& array) { array.clear(); });
  auto next_anchor = scratch.anchors.begin();
  const auto take_anchors_below = [&](std::uint32_t vertex) {
    for (; next_anchor != scratch.anchors.end() && *next_anchor < vertex; ++next_anchor) {
      state::touch_column(surface, soil, *next_anchor);
      append_row(scratch.next, particles, surface, soil, media, *next_anchor, true);
    }
  };
  for (const std::uint32_t vertex : scratch.awake) {
    take_anchors_below(vertex);
    state::touch_column(surface, soil, vertex);
    append_row(scratch.next, particles, surface, soil, media, vertex, false);
  }
  take_anchors_below(kNone);

  for (const std::uint32_t column : particles.column) soil.particle[column] = kNone;
  std::swap(particles, scratch.next);
  for (std::size_t i = 0; i < particles.size(); ++i) soil.particle[particles.column[i]] = static_cast<std::uint32_t>(i);
  return true;
}

}  // namespace divot::activation
