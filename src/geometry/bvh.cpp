#include "geometry/bvh.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <utility>

#ifdef __SSE2__
#include <immintrin.h>
#endif

namespace divot::geometry {
namespace {

// Numbers of eight boxes, and a bit for each box where something holds. Compilers make scalars with jumps of plain
// loops over them.
using Row = std::array<float, 8>;

#ifdef __SSE2__
using Four = __m128;
Four four(const Row& row, std::size_t half) { return _mm_loadu_ps(row.data() + 4 * half); }
Four four(float x) { return _mm_set1_ps(x); }
std::uint32_t at_most(Four a, Four b) { return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmple_ps(a, b))); }
Four greatest(Four a, Four b) { return _mm_max_ps(a, b); }
#else
using Four = std::array<float, 4>;
Four four(const Row& row, std::size_t half) {
  return {row[4 * half], row[4 * half + 1], row[4 * half + 2], row[4 * half + 3]};
}
Four four(float x) { return {x, x, x, x}; }
std::uint32_t at_most(const Four& a, const Four& b) {
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < 4; ++k) bits |= static_cast<std::uint32_t>(a[k] <= b[k]) << k;
  return bits;
}
template <class F>
Four each(const Four& a, const Four& b, F f) {
  return {f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2]), f(a[3], b[3])};
}
Four operator-(const Four& a, const Four& b) { return each(a, b, std::minus<float>()); }
Four operator+(const Four& a, const Four& b) { return each(a, b, std::plus<float>()); }
Four operator*(const Four& a, const Four& b) { return each(a, b, std::multiplies<float>()); }
Four greatest(const Four& a, const Four& b) {
  return each(a, b, [](float x, float y) { return std::max(x, y); });
}
#endif

}  // namespace

Bvh::Eight::Eight() {
  for (std::uint32_t k = 0; k < kWide; ++k) set(k, {});
}

math::Aabb Bvh::Eight::box(std::uint32_t k) const {
  math::Aabb box;
  box.low = {low[0][k], low[1][k], low[2][k]};
  box.high = {high[0][k], high[1][k], high[2][k]};
  return box;
}

void Bvh::Eight::set(std::uint32_t k, const math::Aabb& box) {
  low[0][k] = box.low.x, low[1][k] = box.low.y, low[2][k] = box.low.z;
  high[0][k] = box.high.x, high[1][k] = box.high.y, high[2][k] = box.high.z;
}

math::Aabb Bvh::Eight::all() const {
  math::Aabb around;
  for (std::uint32_t k = 0; k < kWide; ++k) around.include(box(k));
  return around;
}

std::size_t Bvh::leaf_end(std::uint32_t leaf) const {
  return std::min((std::size_t{leaf} + 1) * kLeafFaces, face_count_);
}

math::Aabb Bvh::box_of(std::uint32_t level, std::uint32_t index) const {
  return blocks_[level_[level].first + index / kWide].box(index % kWide);
}

// What a box has to be now: round the faces of a leaf, or round the eight below.
math::Aabb Bvh::fresh_box(std::uint32_t level, std::uint32_t index, const Corners& corners,
                          std::span<const Vec3> positions) const {
  if (level > 0) return blocks_[level_[level - 1].first + index].all();
  math::Aabb box;
  for (std::size_t slot = std::size_t{index} * kLeafFaces; slot < leaf_end(index); ++slot)
    for (const std::uint32_t corner : corners(face_at(slot))) box.include(positions[corner]);
  box.grow(margin_);
  return box;
}

std::vector<math::Aabb> Bvh::boxes(int level) const {
  std::vector<math::Aabb> found;
  if (levels_ == 0 || level < 0 || level > static_cast<int>(levels_)) return found;
  if (level == 0) return {blocks_.back().all()};
  const std::uint32_t depth = levels_ - static_cast<std::uint32_t>(level);
  for (std::uint32_t index = 0; index < level_[depth].count; ++index) found.push_back(box_of(depth, index));
  return found;
}

// False when it was marked already.
bool Bvh::mark(std::uint32_t level, std::uint32_t index) {
  std::uint8_t& bits = dirty_[level_[level].first + index / kWide];
  const auto bit = static_cast<std::uint8_t>(1u << index % kWide);
  return (std::exchange(bits, static_cast<std::uint8_t>(bits | bit)) & bit) == 0;
}

bool Bvh::touch(std::uint32_t face, const Vec3& corner) {
  const std::uint32_t leaf = leaf_of(face);
  if (box_of(0, leaf).contains(corner)) return false;
  if (mark(0, leaf)) touched_.push_back(leaf);
  return true;
}

std::size_t Bvh::refit(const Corners& corners, std::span<const Vec3> positions) {
  std::size_t changed = 0;
  for (std::uint32_t level = 0; level < levels_ && !touched_.empty(); ++level) {
    upwards_.clear();
    for (const std::uint32_t index : touched_) {
      Eight& block = blocks_[level_[level].first + index / kWide];
      dirty_[level_[level].first + index / kWide] = 0;
      const math::Aabb box = fresh_box(level, index, corners, positions), old = block.box(index % kWide);
      if (box.low == old.low && box.high == old.high) continue;
      area_ += static_cast<double>(box.half_area()) - static_cast<double>(old.half_area());
      block.set(index % kWide, box);
      ++changed;
      if (level + 1 < levels_ && mark(level + 1, index / kWide)) upwards_.push_back(index / kWide);
    }
    touched_.swap(upwards_);
  }
  touched_.clear();
  return changed;
}

void Bvh::refit_all(const Corners& corners, std::span<const Vec3> positions, const Jobs& jobs) {
  constexpr std::size_t kGrain = 1 << 10;
  area_ = 0;
  for (std::uint32_t level = 0; level < levels_; ++level) {
    const auto renew = [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto index = static_cast<std::uint32_t>(i);
        blocks_[level_[level].first + index / kWide].set(index % kWide, fresh_box(level, index, corners, positions));
      }
    };
    // By reference: a copy in std::function would be an allocation.
    jobs.for_ranges(level_[level].count, kGrain, std::ref(renew));
    for (std::uint32_t i = 0; i < level_[level].count; ++i) area_ += static_cast<double>(box_of(level, i).half_area());
  }
  std::fill(dirty_.begin(), dirty_.end(), std::uint8_t{0});
  touched_.clear();
}

float Bvh::degradation() const { return built_area_ > 0 ? static_cast<float>(area_ / built_area_) : 1.0f; }

// Depth first, so that leaves come in their order. `hit` says of eight boxes which are met, a bit for each.
template <class Hit>
void Bvh::collect(const Hit& hit, std::vector<std::uint32_t>& faces) const {
  if (levels_ == 0) return;
  const std::size_t before = faces.size();
  std::array<std::uint32_t, kMostLevels> block{}, met{};
  const auto enter = [&](std::uint32_t level, std::uint32_t index) {
    block[level] = index;
    // Empty boxes beyond the last are met by what has no end.
    const std::uint32_t count = level_[level].count - index * kWide;
    met[level] = hit(blocks_[level_[level].first + index]) & (count < kWide ? (1u << count) - 1 : 0xffu);
  };
  std::uint32_t level = levels_ - 1;
  for (enter(level, 0);;) {
    if (met[level] == 0) {
      if (++level == levels_) break;
      continue;
    }
    const std::uint32_t below = block[level] * kWide + static_cast<std::uint32_t>(std::countr_zero(met[level]));
    met[level] &= met[level] - 1;
    if (level > 0) {
      enter(--level, below);
      continue;
    }
    const std::size_t first = std::size_t{below} * kLeafFaces, count = leaf_end(below) - first, have = faces.size();
    faces.resize(have + count);
    for (std::size_t i = 0; i < count; ++i) faces[have + i] = face_at(first + i);
  }
  if (!faces_.empty()) std::sort(faces.begin() + static_cast<std::ptrdiff_t>(before), faces.end());
}

void Bvh::query(const math::Aabb& box, std::vector<std::uint32_t>& faces) const {
  const std::array low{box.low.x, box.low.y, box.low.z}, high{box.high.x, box.high.y, box.high.z};
  const auto hit = [&](const Eight& eight) {
    std::array<std::uint32_t, 2> met{0xf, 0xf};
    for (std::size_t half = 0; half < 2; ++half)
      for (std::size_t axis = 0; axis < 3; ++axis)
        met[half] &= at_most(four(eight.low[axis], half), four(high[axis])) &
                     at_most(four(low[axis]), four(eight.high[axis], half));
    return met[0] | met[1] << 4;
  };
  collect(hit, faces);
}

void Bvh::query_sphere(const Vec3& center, float radius, std::vector<std::uint32_t>& faces) const {
  // A little more than the radius, so that rounding of the distance loses no face that touches the ball.
  const Four reach = four(radius * radius * (1 + 1e-6f)), zero = four(0.0f);
  const std::array at{center.x, center.y, center.z};
  const auto hit = [&](const Eight& eight) {
    std::array<std::uint32_t, 2> met{};
    for (std::size_t half = 0; half < 2; ++half) {
      Four squared = zero;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Four below = four(eight.low[axis], half) - four(at[axis]);
        const Four above = four(at[axis]) - four(eight.high[axis], half);
        const Four away = greatest(greatest(below, above), zero);
        squared = squared + away * away;
      }
      met[half] = at_most(squared, reach);
    }
    return met[0] | met[1] << 4;
  };
  collect(hit, faces);
}

}  // namespace divot::geometry
