#include <algorithm>
#include <functional>

#include "core/assert.h"
#include "geometry/bvh.h"

namespace divot::geometry {
namespace {

constexpr std::size_t kParts = 64;       // subtrees that are built side by side
constexpr std::size_t kGrain = 1 << 13;  // faces or leaves a thread takes at a time

}  // namespace

// Halves a part at the median of its longer side. Shape and place of all nodes follow from the number of leaves alone,
// so parts can be split in any order.
std::array<Bvh::Part, 2> Bvh::split(const Part& part) {
  if (part.leaf_count == 0) return {};
  Node& node = nodes_[part.node];
  node.skip = part.node + 2 * part.leaf_count - 1;
  node.leaf = part.leaf_count == 1 ? part.first_leaf : kNone;
  if (part.leaf_count == 1) {
    leaf_node_[part.first_leaf] = part.node;
    return {};
  }

  const auto begin = items_.begin() + std::size_t{part.first_leaf} * kLeafFaces;
  const auto end = items_.begin() + leaf_end(part.first_leaf + part.leaf_count - 1);
  math::Aabb bounds;
  for (auto item = begin; item != end; ++item) bounds.include(Vec3{item->centre[0], item->centre[1], item->centre[2]});
  const Vec3 size = bounds.high - bounds.low;
  const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;

  const std::uint32_t half = part.leaf_count / 2;
  std::nth_element(begin, begin + std::size_t{half} * kLeafFaces, end, [axis](const Item& a, const Item& b) {
    return a.centre[axis] < b.centre[axis] || (a.centre[axis] == b.centre[axis] && a.face < b.face);
  });
  const Part first{part.node + 1, part.first_leaf, half};
  const Part second{part.node + 2 * half, part.first_leaf + half, part.leaf_count - half};
  parent_[first.node] = parent_[second.node] = part.node;
  return {first, second};
}

void Bvh::split_all(const Part& part) {
  for (const Part& child : split(part))
    if (child.leaf_count > 0) split_all(child);
}

// Writes the faces of leaves [begin, end) in ascending order, with their corners.
void Bvh::fill_leaves(std::span<const std::uint32_t> triangles, std::size_t begin, std::size_t end) {
  for (std::size_t leaf = begin; leaf < end; ++leaf) {
    const std::size_t first = leaf * kLeafFaces, last = leaf_end(static_cast<std::uint32_t>(leaf));
    for (std::size_t slot = first; slot < last; ++slot) faces_[slot] = items_[slot].face;
    std::sort(faces_.begin() + first, faces_.begin() + last);
    for (std::size_t slot = first; slot < last; ++slot) {
      const std::size_t face = faces_[slot];
      leaf_of_[face] = static_cast<std::uint32_t>(leaf);
      for (std::size_t k = 0; k < 3; ++k) corners_[3 * slot + k] = triangles[3 * face + k];
    }
  }
}

void Bvh::build(std::span<const std::uint32_t> triangles, std::span<const Vec3> positions, float margin,
                const Jobs& jobs) {
  DIVOT_ASSERT(triangles.size() % 3 == 0 && triangles.size() < kNone && margin >= 0);
  const std::size_t count = triangles.size() / 3, leaves = (count + kLeafFaces - 1) / kLeafFaces;
  const bool is_first = nodes_.empty();
  margin_ = margin;
  items_.resize(count), faces_.resize(count), leaf_of_.resize(count), corners_.resize(3 * count);
  leaf_node_.resize(leaves);
  nodes_.resize(leaves == 0 ? 0 : 2 * leaves - 1);
  parent_.assign(nodes_.size(), kNone);
  dirty_.assign(nodes_.size(), 0);
  heap_.clear(), heap_.reserve(nodes_.size());

  // Three times the centre of each face serves as well as the centre.
  const auto fill_items = [&](std::size_t begin, std::size_t end) {
    for (std::size_t face = begin; face < end; ++face) {
      const std::uint32_t* corner = &triangles[3 * face];
      const Vec3 centre = positions[corner[0]] + positions[corner[1]] + positions[corner[2]];
      items_[face] = {{centre.x, centre.y, centre.z}, static_cast<std::uint32_t>(face)};
    }
  };
  // By reference: a copy in std::function would be an allocation.
  jobs.for_ranges(count, kGrain, std::ref(fill_items));

  // Level by level until there are enough parts for all threads, then each part by itself.
  parts_.assign(1, Part{0, 0, static_cast<std::uint32_t>(leaves)});
  while (parts_.size() < kParts) {
    child_parts_.resize(2 * parts_.size());
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

  const auto fill = [&](std::size_t begin, std::size_t end) { fill_leaves(triangles, begin, end); };
  jobs.for_ranges(leaves, kGrain, std::ref(fill));
  if (is_first) std::vector<Item>().swap(items_);  // an empty list would keep its memory
  refit_all(positions);
  built_area_ = area_;
}

}  // namespace divot::geometry
