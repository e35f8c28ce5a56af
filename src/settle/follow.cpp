#include "settle/follow.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <functional>

#include "math/processor.h"

namespace divot::settle {
namespace {

constexpr std::size_t kGrain = 2048, kBlockGrain = 256, kPart = 1 << 14;
// Rings cost as much as a step without them: they are made once particles have stayed the same for so many steps.
constexpr int kSettledSteps = 2;

// Who is still waits for others for such a share of that time, as the set of particles is dear to change.
constexpr int kPatience = 4;

// Of numbers that are not negative, whose bits are in the same order.
void raise(std::atomic<std::uint32_t>& most, float to) {
  const auto bits = std::bit_cast<std::uint32_t>(to);
  std::uint32_t now = most.load();
  while (now < bits && !most.compare_exchange_weak(now, bits)) {
  }
}

// Moves what is above particles [begin, end). Far from the origin a creep can be too slow for a float to take a step.
struct Mover {
  const Stillness& stillness;
  Ground& ground;
  FollowScratch& s;
  std::atomic<std::uint32_t> furthest = 0, furthest_free = 0;
  std::atomic<bool> sleepy = false;

  void operator()(std::size_t begin, std::size_t end) {
    const state::Particles& p = ground.particles;
    float most = 0, most_free = 0;  // m^2
    const int late = std::min(stillness.steps + stillness.steps / kPatience, 0xffff);
    bool still = false;
    for (std::size_t i = begin; i < end; ++i) {
      s.dx[i] = s.dy[i] = s.dz[i] = 0, s.moved[i] = 0;
      if (p.hold[i] == Hold::anchor) continue;
      const float squared = move(i);
      most = std::max(most, squared);
      if (p.hold[i] != Hold::free) continue;
      most_free = std::max(most_free, squared);
      still |= p.still_steps[i] >= late;
    }
    raise(furthest, std::sqrt(most)), raise(furthest_free, std::sqrt(most_free));
    if (still) sleepy = true;
  }

  // Returns the square of its way.
  float move(std::size_t i) {
    state::Particles& p = ground.particles;
    const std::uint32_t vertex = p.vertex[i];
    Vec3& surface = ground.surface.position[vertex];
    const Vec3 place = surface;
    // The border of the terrain, and of holes in it, stays where it is on the map.
    if (s.rings.valid ? s.rings.border[i] != 0 : ground.surface.mesh.is_boundary(vertex))
      p.x[i] = place.x, p.y[i] = place.y;
    const Vec3 way = p.position(i) - place, velocity = p.velocity(i);
    const float squared = dot(way, way);
    const bool still =
        dot(velocity, velocity) < stillness.speed * stillness.speed || squared < stillness.step * stillness.step;
    p.still_steps[i] = still ? static_cast<std::uint16_t>(std::min(p.still_steps[i] + 1, 0xffff)) : std::uint16_t{0};
    if (way == Vec3{}) return 0;
    s.dx[i] = way.x, s.dy[i] = way.y, s.dz[i] = way.z, s.moved[i] = 1;
    surface = p.position(i);
    // A blast loosens what it makes flow; any other load packs what lay loose.
    float& loose = ground.soil.loose[p.column[i]];
    const float sunk = place.z - p.z[i];
    ground.soil.lift_excess(p.column[i], -sunk);
    loose = std::max(0.0f, p.flow_rate[i] > 0 ? loose + std::abs(sunk) : loose - std::max(0.0f, sunk));
    return squared;
  }
};

// The same as RingKernel::sweep without rings, and their reference.
float sweep_one(const Ground& ground, const FollowScratch& s, std::size_t i) {
  const state::Surface& surface = ground.surface;
  const Vec3 here = ground.particles.position(i);
  const auto spoke = [&](std::uint32_t vertex) {
    const Vec3 to = surface.position[vertex] - here;
    const std::uint32_t column = surface.column[vertex], j = column == kNone ? kNone : ground.soil.particle[column];
    const float dx = j == kNone ? 0 : s.dx[j], dy = j == kNone ? 0 : s.dy[j], dz = j == kNone ? 0 : s.dz[j];
    return halfway(Spoke<float>{to.x, to.y, to.z, dx - s.dx[i], dy - s.dy[i], dz - s.dz[i]});
  };
  Area<float> area{0, 0, 0};
  surface.mesh.for_each_outgoing(ground.particles.vertex[i], [&](std::uint32_t h) {
    add_mean_area(spoke(surface.mesh.target(h)), spoke(surface.mesh.origin(geometry::HalfEdgeMesh::prev(h))), area);
  });
  return swept(area, s.dx[i], s.dy[i], s.dz[i]);
}

RingArrays arrays_of(const state::Particles& p, FollowScratch& s) {
  return {p.size(),
          p.x.data(),
          p.y.data(),
          p.z.data(),
          s.dx.data(),
          s.dy.data(),
          s.dz.data(),
          nullptr,
          s.rings.first.data(),
          s.rings.neighbour.data(),
          s.rings.reads.data(),
          s.lost.data(),
          s.steep.data(),
          {}};
}

// Appends the vertices of particles whose flag is set, ascending.
void list(const std::vector<std::uint8_t>& flag, const state::Particles& p, std::vector<std::uint32_t>& count,
          std::vector<std::uint32_t>& vertices, const Jobs& jobs) {
  const std::size_t parts = (p.size() + kPart - 1) / kPart;
  count.assign(parts + 1, 0);
  const auto end_of = [&](std::size_t part) { return std::min(p.size(), (part + 1) * kPart); };
  const auto count_all = [&](std::size_t begin, std::size_t end) {
    for (std::size_t part = begin; part < end; ++part) {
      std::uint32_t here = 0;
      for (std::size_t i = part * kPart; i < end_of(part); ++i) here += flag[i];
      count[part + 1] = here;
    }
  };
  jobs.for_ranges(parts, 1, std::ref(count_all));
  count[0] = static_cast<std::uint32_t>(vertices.size());
  for (std::size_t part = 0; part < parts; ++part) count[part + 1] += count[part];
  vertices.resize(count[parts]);
  const auto fill_all = [&](std::size_t begin, std::size_t end) {
    for (std::size_t part = begin; part < end; ++part) {
      if (count[part + 1] == count[part]) continue;
      std::uint32_t at = count[part];
      for (std::size_t i = part * kPart; i < end_of(part); ++i)
        if (flag[i] != 0) vertices[at++] = p.vertex[i];
    }
  };
  jobs.for_ranges(parts, 1, std::ref(fill_all));
}

}  // namespace

std::vector<const RingKernel*> ring_kernels() {
  std::vector<const RingKernel*> list;
#if defined(__x86_64__)
  if (math::has_avx512()) list.push_back(&kRingsAvx512);
  if (math::has_avx2()) list.push_back(&kRingsAvx2);
#endif
  list.push_back(&kRingsBaseline);
  return list;
}

const RingKernel& fastest_rings() {
  static const RingKernel& kFastest = *ring_kernels().front();
  return kFastest;
}

void follow(const Stillness& stillness, bool particles_changed, Ground& ground, FollowScratch& s, const Jobs& jobs,
            const RingKernel& kernel) {
  const state::Particles& p = ground.particles;
  for (auto* array : {&s.dx, &s.dy, &s.dz, &s.lost}) array->resize(p.size());
  s.moved.resize(p.size()), s.steep.resize(p.size());
  s.unchanged = particles_changed ? 0 : s.unchanged + 1;
  if (particles_changed) s.rings.valid = false;
  if (s.unchanged == kSettledSteps) make_rings(p, ground.soil, ground.surface, s.rings, jobs);

  Mover mover{stillness, ground, s};
  jobs.for_ranges(p.size(), kGrain, std::ref(mover));  // by reference: a copy would be an allocation
  ground.moved.distance = std::bit_cast<float>(mover.furthest.load());
  ground.moved.free_distance = std::bit_cast<float>(mover.furthest_free.load());
  s.sleepy = mover.sleepy;

  const RingArrays arrays = arrays_of(p, s);
  const auto sweep = [&](std::size_t begin, std::size_t end) {
    const std::size_t last = std::min(p.size(), end * Rings::kLanes);
    if (s.rings.valid) kernel.sweep(arrays, begin, end);
    for (std::size_t i = begin * Rings::kLanes; i < last; ++i) {
      if (!s.rings.valid) s.lost[i] = s.moved[i] != 0 ? sweep_one(ground, s, i) : 0;
      if (s.moved[i] != 0)
        ground.soil.compacted[p.column[i]] += static_cast<double>(s.lost[i]);
      else
        s.lost[i] = 0;
    }
  };
  jobs.for_ranges((p.size() + Rings::kLanes - 1) / Rings::kLanes, kBlockGrain, std::ref(sweep));
  list(s.moved, p, s.part, ground.moved.vertices, jobs);
}

void add_restless(const Slopes& slopes, const Ground& ground, FollowScratch& s, const Jobs& jobs,
                  std::vector<std::uint32_t>& restless, const RingKernel& kernel) {
  const state::Particles& p = ground.particles;
  if (!s.rings.valid) return list(s.moved, p, s.part, restless, jobs);
  RingArrays arrays = arrays_of(p, s);
  arrays.slopes = slopes;
  if (slopes.edges) {
    s.excess.resize(p.size());
    const auto copy = [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) s.excess[i] = ground.soil.excess[p.column[i]];
    };
    jobs.for_ranges(p.size(), kGrain, std::ref(copy));
    arrays.excess = s.excess.data();
  }
  const auto look = [&](std::size_t begin, std::size_t end) {
    kernel.look(arrays, begin, end);
    const std::size_t last = std::min(p.size(), end * Rings::kLanes);
    for (std::size_t i = begin * Rings::kLanes; i < last; ++i) s.steep[i] &= s.moved[i];
  };
  jobs.for_ranges((p.size() + Rings::kLanes - 1) / Rings::kLanes, kBlockGrain, std::ref(look));
  list(s.steep, p, s.part, restless, jobs);
}

}  // namespace divot::settle
