#include "neighbours/neighbours.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>

#include "math/aabb.h"
#include "neighbours/blocks.h"

namespace divot::neighbours {
namespace {

constexpr std::size_t kGrain = 1024, kDriftPart = 1 << 14;

float distance_squared(const state::Particles& p, std::size_t i, std::size_t j) {
  const float dx = p.x[i] - p.x[j], dy = p.y[i] - p.y[j], dz = p.z[i] - p.z[j];
  return (dx * dx + dy * dy) + dz * dz;
}

// Could two particles have come nearer to each other, seen from above, by more than the skin since the rows were built?
// Only motion against each other counts: what all have in common, half the extent of their displacements, is taken off
// first.
bool has_drifted(const state::Particles& p, Index& index, float skin, const Jobs& jobs) {
  const std::size_t parts = (p.size() + kDriftPart - 1) / kDriftPart;
  index.drift.assign(parts, {});
  const auto measure = [&](std::size_t begin, std::size_t end) {
    for (std::size_t part = begin; part < end; ++part) {
      const std::size_t first = part * kDriftPart, last = std::min(p.size(), first + kDriftPart);
      math::Aabb& moved = index.drift[part];
      const auto extent = [&](const float* now, const float* then, float& low, float& high) {
        // Eight at a time, as wide as registers are: the compiler may not reorder a running minimum by itself.
        std::array<float, 8> least, most;
        least.fill(math::Aabb::kInf), most.fill(-math::Aabb::kInf);
        std::size_t i = first;
        for (; i + 8 <= last; i += 8)
          for (std::size_t lane = 0; lane < 8; ++lane) {
            const float by = now[i + lane] - then[i + lane];
            least[lane] = by < least[lane] ? by : least[lane], most[lane] = by > most[lane] ? by : most[lane];
          }
        for (; i < last; ++i)
          least[0] = std::min(least[0], now[i] - then[i]), most[0] = std::max(most[0], now[i] - then[i]);
        low = *std::min_element(least.begin(), least.end()), high = *std::max_element(most.begin(), most.end());
      };
      extent(p.x.data(), index.x.data(), moved.low.x, moved.high.x);
      extent(p.y.data(), index.y.data(), moved.low.y, moved.high.y);
    }
  };
  jobs.for_ranges(parts, 1, std::ref(measure));
  math::Aabb all;
  for (const math::Aabb& moved : index.drift) all.include(moved);
  return p.size() > 0 && std::hypot(all.high.x - all.low.x, all.high.y - all.low.y) > skin;
}

bool is_due(const state::Particles& p, Index& index, const Reach& reach, bool particles_changed, const Jobs& jobs) {
  if (particles_changed) return true;
  switch (reach.policy.kind) {
    case UpdatePolicy::Kind::every_step:
      return true;
    case UpdatePolicy::Kind::every:
      return index.steps_since_build >= static_cast<std::uint64_t>(reach.policy.steps);
    case UpdatePolicy::Kind::adaptive:
      return has_drifted(p, index, reach.skin, jobs);
  }
  return true;
}

// Row of a vertex in the rows before; their number where it has none.
std::size_t old_row_of(const Index& index, std::uint32_t vertex) {
  const auto found = std::lower_bound(index.old_vertex.begin(), index.old_vertex.end(), vertex);
  const bool is_there = found != index.old_vertex.end() && *found == vertex;
  return is_there ? static_cast<std::size_t>(found - index.old_vertex.begin()) : index.old_vertex.size();
}

// Entries of one row of bonds, ascending.
class Row {
 public:
  Row(const state::Bonds& bonds, std::size_t i)
      : bonds_(bonds),
        entry_(std::size_t{bonds.first[i / kLanes]} * kLanes + i % kLanes),
        end_(std::size_t{bonds.first[i / kLanes + 1]} * kLanes) {
    skip();
  }
  bool is_over() const { return entry_ >= end_; }
  std::size_t entry() const { return entry_; }
  std::uint32_t neighbour() const { return bonds_.neighbour[entry_]; }
  void advance() { entry_ += kLanes, skip(); }

 private:
  static constexpr std::size_t kLanes = state::Bonds::kLanes;
  void skip() {
    while (entry_ < end_ && bonds_.rest_length[entry_] < 0) entry_ += kLanes;
  }
  const state::Bonds& bonds_;
  std::size_t entry_, end_;
};

// Rest lengths move from the old rows to the new ones, found by vertex: both ascend. Returns how many pairs are in
// range now that the old rows should have held and did not, each counted once.
std::uint64_t carry_rest_lengths(const state::Particles& p, const Index& index, state::Bonds& bonds, float cutoff,
                                 const Jobs& jobs) {
  std::atomic<std::uint64_t> missed = 0;
  const bool same_rows = index.vertex == index.old_vertex;
  const auto carry = [&](std::size_t begin, std::size_t end) {
    std::uint64_t missed_here = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t old_row = same_rows ? i : old_row_of(index, index.vertex[i]);
      if (old_row == index.old_vertex.size()) continue;
      const auto old_vertex = [&](const Row& row) { return index.old_vertex[row.neighbour()]; };
      Row old(index.old_bonds, old_row);
      for (Row now(bonds, i); !now.is_over(); now.advance()) {
        const std::uint32_t j = now.neighbour(), wanted = index.vertex[j];
        while (!old.is_over() && old_vertex(old) < wanted) old.advance();
        if (!old.is_over() && old_vertex(old) == wanted)
          bonds.rest_length[now.entry()] = index.old_bonds.rest_length[old.entry()];
        else if (i < j && distance_squared(p, i, j) < cutoff * cutoff)
          missed_here += same_rows || old_row_of(index, wanted) < index.old_vertex.size();
      }
    }
    missed += missed_here;
  };
  jobs.for_ranges(p.size(), kGrain, std::ref(carry));
  return missed;
}

void rebuild(const state::Particles& p, state::Bonds& bonds, Index& index, const Reach& reach, const Jobs& jobs) {
  const bool skinned = reach.policy.kind == UpdatePolicy::Kind::adaptive;
  const float radius = reach.cutoff + (skinned ? reach.skin : 0);
  std::swap(index.old_vertex, index.vertex);
  std::swap(index.old_bonds, bonds);
  index.vertex = p.vertex;
  // Seen from above: what a body presses down may then go as deep as it wants before rows have to be made anew.
  index.x = p.x, index.y = p.y, index.level.assign(p.size(), 0.0f);
  if (reach.structure == Neighbours::kd_tree) {
    index.kd_tree.build(p.x, p.y, index.level);
    index.kd_tree.rows(radius, index.rows, jobs);
  } else {
    index.grid.build(p.x, p.y, index.level);
    index.grid.rows(radius, index.rows, jobs);
  }
  make_blocks(index.rows, p.material, index.slots, bonds, jobs);
  // Rows a single step old can miss nothing that matters: a pair bonds in the step in which it comes into range.
  const std::uint64_t missed = carry_rest_lengths(p, index, bonds, reach.cutoff, jobs);
  if (index.steps_since_build > 1) index.missed_pairs += missed;
  index.steps_since_build = 0;
  ++index.rebuilds;
}

}  // namespace

void update(const state::Particles& particles, state::Bonds& bonds, Index& index, const Reach& reach,
            bool particles_changed, const Jobs& jobs) {
  ++index.steps_since_build;
  if (is_due(particles, index, reach, particles_changed, jobs)) rebuild(particles, bonds, index, reach, jobs);
}

}  // namespace divot::neighbours
