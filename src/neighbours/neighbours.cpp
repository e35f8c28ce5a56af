#include "neighbours/neighbours.h"

#include <algorithm>
#include <cmath>

namespace divot::neighbours {
namespace {

constexpr std::size_t kGrain = 1024;

float distance_squared(const state::Particles& p, std::size_t i, std::size_t j) {
  const float dx = p.x[i] - p.x[j], dy = p.y[i] - p.y[j], dz = p.z[i] - p.z[j];
  return (dx * dx + dy * dy) + dz * dz;
}

// Has any particle moved more than half the skin since the rows were built?
bool has_drifted(const state::Particles& p, const Index& index, float skin) {
  const float limit = skin * skin / 4;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const float dx = p.x[i] - index.x[i], dy = p.y[i] - index.y[i], dz = p.z[i] - index.z[i];
    if (dx * dx + dy * dy + dz * dz > limit) return true;
  }
  return false;
}

bool is_due(const state::Particles& p, const Index& index, const Reach& reach, bool particles_changed) {
  if (particles_changed) return true;
  switch (reach.policy.kind) {
    case UpdatePolicy::Kind::every_step: return true;
    case UpdatePolicy::Kind::every: return index.steps_since_build >= static_cast<std::uint64_t>(reach.policy.steps);
    case UpdatePolicy::Kind::adaptive: return has_drifted(p, index, reach.skin);
  }
  return true;
}

// Rest lengths move from the old rows to the new ones, found by vertex: both lists ascend.
void carry_rest_lengths(const Index& index, state::Bonds& bonds, const Jobs& jobs) {
  jobs.for_ranges(index.vertex.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto found = std::lower_bound(index.old_vertex.begin(), index.old_vertex.end(), index.vertex[i]);
      if (found == index.old_vertex.end() || *found != index.vertex[i]) continue;
      const auto old_row = static_cast<std::size_t>(found - index.old_vertex.begin());
      std::uint32_t old = index.old_bonds.start[old_row];
      const std::uint32_t old_end = index.old_bonds.start[old_row + 1];
      for (std::uint32_t e = bonds.start[i]; e < bonds.start[i + 1]; ++e) {
        const std::uint32_t wanted = index.vertex[bonds.neighbour[e]];
        while (old < old_end && index.old_vertex[index.old_bonds.neighbour[old]] < wanted) ++old;
        if (old < old_end && index.old_vertex[index.old_bonds.neighbour[old]] == wanted)
          bonds.rest_length[e] = index.old_bonds.rest_length[old];
      }
    }
  });
}

void rebuild(const state::Particles& p, state::Bonds& bonds, Index& index, const Reach& reach, const Jobs& jobs) {
  const bool skinned = reach.policy.kind == UpdatePolicy::Kind::adaptive;
  const float radius = reach.cutoff + (skinned ? reach.skin : 0);
  std::swap(index.old_vertex, index.vertex);
  std::swap(index.old_bonds, bonds);
  if (index.old_bonds.start.empty()) index.old_bonds.start.push_back(0);
  index.vertex = p.vertex;
  index.x = p.x, index.y = p.y, index.z = p.z;
  if (reach.structure == Neighbours::kd_tree) {
    index.kd_tree.build(p.x, p.y, p.z);
    index.kd_tree.rows(radius, index.rows, jobs);
  } else {
    index.grid.build(p.x, p.y, p.z);
    index.grid.rows(radius, index.rows, jobs);
  }
  bonds.start = index.rows.start;
  bonds.neighbour = index.rows.index;
  bonds.rest_length.assign(bonds.neighbour.size(), 0);
  carry_rest_lengths(index, bonds, jobs);
  index.steps_since_build = 0;
  ++index.rebuilds;
}

// Pairs that are in range although the rows of the steps before did not hold them, each counted once.
std::uint64_t count_missed(const state::Particles& p, const state::Bonds& bonds, const Index& index, float cutoff) {
  std::uint64_t missed = 0;
  const auto row_of = [&](std::uint32_t vertex) {
    return std::lower_bound(index.old_vertex.begin(), index.old_vertex.end(), vertex) - index.old_vertex.begin();
  };
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto row = static_cast<std::size_t>(row_of(p.vertex[i]));
    if (row >= index.old_vertex.size() || index.old_vertex[row] != p.vertex[i]) continue;
    const auto first = index.old_bonds.neighbour.begin() + index.old_bonds.start[row];
    const auto last = index.old_bonds.neighbour.begin() + index.old_bonds.start[row + 1];
    for (std::uint32_t e = bonds.start[i]; e < bonds.start[i + 1]; ++e) {
      const std::uint32_t j = bonds.neighbour[e];
      if (j < i || distance_squared(p, i, j) >= cutoff * cutoff) continue;
      const auto old_j = static_cast<std::size_t>(row_of(p.vertex[j]));
      if (old_j >= index.old_vertex.size() || index.old_vertex[old_j] != p.vertex[j]) continue;
      missed += !std::binary_search(first, last, static_cast<std::uint32_t>(old_j));
    }
  }
  return missed;
}

void form_and_break(const state::Particles& p, state::Bonds& bonds, float cutoff, const Jobs& jobs) {
  jobs.for_ranges(p.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::uint32_t e = bonds.start[i]; e < bonds.start[i + 1]; ++e) {
        const std::uint32_t j = bonds.neighbour[e];
        const float r = std::sqrt(distance_squared(p, i, j));
        // Soil that flows holds together no more; it bonds anew, in its new shape, when it has come to rest.
        if (r >= cutoff || p.flow_rate[i] > 0 || p.flow_rate[j] > 0)
          bonds.rest_length[e] = 0;
        else if (bonds.rest_length[e] == 0)
          bonds.rest_length[e] = r;
      }
    }
  });
}

}  // namespace

void update(const state::Particles& particles, state::Bonds& bonds, Index& index, const Reach& reach, bool particles_changed,
            const Jobs& jobs) {
  ++index.steps_since_build;
  if (is_due(particles, index, reach, particles_changed)) {
    // Rows a single step old can miss nothing that matters: a pair bonds in the step in which it comes into range.
    const bool were_stale = index.steps_since_build > 1;
    rebuild(particles, bonds, index, reach, jobs);
    if (were_stale) index.missed_pairs += count_missed(particles, bonds, index, reach.cutoff);
  }
  form_and_break(particles, bonds, reach.cutoff, jobs);
}

}  // namespace divot::neighbours
