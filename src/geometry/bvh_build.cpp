#include <algorithm>
#include <functional>

#include "core/assert.h"
#include "geometry/bvh.h"

namespace divot::geometry {
namespace {

constexpr std::size_t kParts = 64;       // subtrees that are built side by side
constexpr std::size_t kGrain = 1 << 13;  // faces or leaves a thread takes at a time

}  // namespace

void Bvh::lay_out_levels() {
  std::size_t blocks = 0;
  levels_ = 0;
  for (std::size_t count = (face_count_ + kLeafFaces - 1) / kLeafFaces; count > 0;
       count = count > kWide ? (count + kWide - 1) / kWide : 0) {
    level_[levels_++] = {static_cast<std::uint32_t>(blocks), static_cast<std::uint32_t>(count)};
    blocks += (count + kWide - 1) / kWide;
  }
  blocks_.assign(blocks, {});
  dirty_.assign(blocks, 0);
  touched_.clear(), touched_.reserve(level_[0].count);
  upwards_.clear(), upwards_.reserve(level_[0].count / kWide + 1);
}

// Halves a part at the median of its longer side, where eights of eights begin. Which leaves are in which part follows
// from their number alone, so parts can be split in any order.
std::array<Bvh::Part, 2> Bvh::split(const Part& part) {
  if (part.leaf_count <= 1) return {};
  std::uint32_t unit = 1;
  while (part.leaf_count > unit * kWide) unit *= kWide;
  const std::uint32_t half = (part.leaf_count + unit - 1) / unit / 2 * unit;

  const auto begin = items_.begin() + std::size_t{part.first_leaf} * kLeafFaces;
  const auto end = items_.begin() + leaf_end(part.first_leaf + part.leaf_count - 1);
  math::Aabb bounds;
  for (auto item = begin; item != end; ++item) bounds.include(Vec3{item->centre[0], item->centre[1], item->centre[2]});
  const Vec3 size = bounds.high - bounds.low;
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::nth_element(begin, begin + std::size_t{half} * kLeafFaces, end, [axis](const Item& a, const Item& b) {
    return a.centre[axis] < b.centre[axis] || (a.centre[axis] == b.centre[axis] && a.face < b.face);
  });
  return {Part{part.first_leaf, half}, Part{part.first_leaf + half, part.leaf_count - half}};
}

void Bvh::split_all(const Part& part) {
  for (const Part& child : split(part))
    if (child.leaf_count > 0) split_all(child);
}

// Writes the faces of leaves [begin, end) in ascending order.
void Bvh::fill_leaves(std::size_t begin, std::size_t end) {
  for (std::size_t leaf = begin; leaf < end; ++leaf) {
    const std::size_t first = leaf * kLeafFaces, last = leaf_end(static_cast<std::uint32_t>(leaf));
    for (std::size_t slot = first; slot < last; ++slot) faces_[slot] = items_[slot].face;
    std::sort(faces_.begin() + first, faces_.begin() + last);
    for (std::size_t slot = first; slot < last; ++slot) leaf_of_[faces_[slot]] = static_cast<std::uint32_t>(leaf);
  }
}

void Bvh::order_by_place(const Corners& corners, std::span<const Vec3> positions, const Jobs& jobs) {
  const std::size_t leaves = level_[0].count;
  const bool is_first = faces_.empty();
  items_.resize(face_count_), faces_.resize(face_count_), leaf_of_.resize(face_count_);

  // Three times the centre of each face serves as well as the centre.
  const auto fill_items = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto face = static_cast<std::uint32_t>(i);
      const auto corner = corners(face);
      const Vec3 centre = positions[corner[0]] + positions[corner[1]] + positions[corner[2]];
      items_[i] = {{centre.x, centre.y, centre.z}, face};
    }
  };
  // By reference: a copy in std::function would be an allocation.
  jobs.for_ranges(face_count_, kGrain, std::ref(fill_items));

  // Level by level until there are enough parts for all threads, then each part by itself.
  parts_.assign(1, Part{0, static_cast<std::uint32_t>(leaves)});
  while (parts_.size() < kParts) {
    child_parts_.assign(2 * parts_.size(), {});
    jobs.for_ranges(parts_.size(), 1, [this](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto children = split(parts_[i]);
        std::copy(children.begin(), children.end(), child_parts_.begin() + 2 * i);
      }
    });
    parts_.swap(child_parts_);
  }
  jobs.for_ranges(parts_.size(), 1, [this](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) split_all(parts_[i]);
  });
  const auto fill = [&](std::size_t begin, std::size_t end) { fill_leaves(begin, end); };
  jobs.for_ranges(leaves, kGrain, std::ref(fill));
  if (is_first) std::vector<Item>().swap(items_);  // an empty list would keep its memory
}

void Bvh::build(std::uint32_t face_count, const Corners& corners, std::span<const Vec3> positions, float margin,
                Order order, const Jobs& jobs) {
  DIVOT_ASSERT(margin >= 0);
  margin_ = margin;
  face_count_ = face_count;
  level_ = {};
  lay_out_levels();
  if (order == Order::by_place)
    order_by_place(corners, positions, jobs);
  else
    faces_.clear(), leaf_of_.clear();
  refit_all(corners, positions, jobs);
  built_area_ = area_;
}

}  // namespace divot::geometry
