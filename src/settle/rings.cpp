#include "settle/rings.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>

namespace divot::settle {
namespace {

constexpr std::uint32_t kLanes = Rings::kLanes;
constexpr std::size_t kGrain = 256;

std::uint32_t particle_at(const state::Soil& soil, const state::Surface& surface, std::uint32_t vertex) {
  const std::uint32_t column = surface.column[vertex];
  return column == kNone ? kNone : soil.particle[column];
}

// Slots of a block: one more than its largest fan has faces.
std::uint32_t slots_of(const state::Particles& p, const state::Surface& surface, std::size_t block) {
  std::uint32_t most = 0;
  for (std::size_t i = block * kLanes; i < std::min(p.size(), (block + 1) * kLanes); ++i) {
    if (p.hold[i] == Hold::anchor) continue;
    std::uint32_t faces = 0;
    surface.mesh.for_each_outgoing(p.vertex[i], [&](std::uint32_t) { ++faces; });
    most = std::max(most, faces + 1);
  }
  return most;
}

// The neighbours round a particle as particles: one more than it has faces.
struct Ring {
  // Fans with more faces are for the way without rings: arrays that grow would be allocations.
  static constexpr std::uint32_t kMost = 32;
  std::array<std::uint32_t, kMost> particle;
  std::uint32_t size = 0;
  bool whole = true;  // all of them are particles, and there is room

  void put(std::uint32_t j) {
    whole &= j != kNone && size < kMost;
    if (whole) particle[size++] = j;
  }
};

Ring ring_of(const state::Particles& p, const state::Soil& soil, const state::Surface& surface, std::size_t i) {
  Ring ring;
  std::uint32_t far = kNone;
  surface.mesh.for_each_outgoing(p.vertex[i], [&](std::uint32_t h) {
    ring.put(particle_at(soil, surface, surface.mesh.target(h)));
    far = surface.mesh.origin(geometry::HalfEdgeMesh::prev(h));
  });
  if (far != kNone) ring.put(particle_at(soil, surface, far));
  return ring;
}

// Fills a block; false where a neighbour is no particle. A fan with fewer faces than another waits at a neighbour while
// it has none where the other has: on a grid, whose fans have eight faces and four in turns, slots are then runs.
bool fill(const state::Particles& p, const state::Soil& soil, const state::Surface& surface, std::size_t block,
          Rings& rings) {
  const std::uint32_t begin = rings.first[block], end = rings.first[block + 1];
  const std::size_t first = block * kLanes;
  std::array<Ring, kLanes> ring;
  std::uint32_t longest = 0;
  for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
    const std::size_t i = first + lane;
    if (i < p.size()) rings.border[i] = surface.mesh.is_boundary(p.vertex[i]);
    if (i < p.size() && p.hold[i] != Hold::anchor) ring[lane] = ring_of(p, soil, surface, i);
    if (!ring[lane].whole) return false;
    if (ring[lane].size > ring[longest].size) longest = lane;
  }
  std::array<std::uint32_t, kLanes> at{};
  for (std::uint32_t slot = begin; slot < end; ++slot) {
    std::array<std::uint32_t, kLanes> particles;
    const std::uint32_t step = ring[longest].particle[slot - begin] - longest;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const Ring& own = ring[lane];
      particles[lane] = kNone;
      if (own.size == 0) continue;
      const bool must = slot == begin || own.size - at[lane] == end - slot;
      if (at[lane] < own.size && (must || own.particle[at[lane]] - lane == step)) ++at[lane];
      particles[lane] = own.particle[at[lane] - 1];
    }
    rings.reads[slot] = state::find_reads(particles, p.size());
    for (std::uint32_t lane = 0; lane < kLanes; ++lane)
      rings.neighbour[std::size_t{slot} * kLanes + lane] = particles[lane] == kNone ? 0 : particles[lane];
  }
  return true;
}

}  // namespace

void make_rings(const state::Particles& p, const state::Soil& soil, const state::Surface& surface, Rings& rings,
                const Jobs& jobs) {
  const std::size_t blocks = (p.size() + kLanes - 1) / kLanes;
  rings.first.resize(blocks + 1);
  rings.first[0] = 0;
  const auto count = [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) rings.first[b + 1] = slots_of(p, surface, b);
  };
  jobs.for_ranges(blocks, kGrain, std::ref(count));  // by reference: a copy would be an allocation
  for (std::size_t b = 0; b < blocks; ++b) rings.first[b + 1] += rings.first[b];
  rings.neighbour.resize(std::size_t{rings.first[blocks]} * kLanes);
  rings.reads.resize(rings.first[blocks]);
  rings.border.resize(p.size());
  std::atomic<bool> whole = true;
  const auto fill_all = [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      if (!fill(p, soil, surface, b, rings)) whole = false;
  };
  jobs.for_ranges(blocks, kGrain, std::ref(fill_all));
  rings.valid = whole;
}

}  // namespace divot::settle
