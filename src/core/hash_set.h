#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "divot/ids.h"

namespace divot::core {

/// A set of ids that is filled and emptied again and again, and takes memory by how many it holds, not by how high they
/// are; core::IdSet is faster where that may be. It has no order and is never listed. kNone is no id.
class HashSet {
 public:
  /// False when it is in already. [O(1), amortized]
  bool insert(std::uint32_t id) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    std::uint32_t& slot = slots_[slot_of(id)];
    if (slot == id) return false;
    slot = id, ++count_;
    return true;
  }

  bool contains(std::uint32_t id) const { return count_ > 0 && slots_[slot_of(id)] == id; }
  std::size_t size() const { return count_; }

  /// Empties the set. [O(most it ever held)]
  void clear() {
    if (count_ > 0) std::fill(slots_.begin(), slots_.end(), kNone);
    count_ = 0;
  }

 private:
  // Where the id is, else the empty slot where it belongs.
  std::size_t slot_of(std::uint32_t id) const {
    const std::size_t last = slots_.size() - 1;
    std::size_t at = (id * 2654435769u) >> (32 - std::countr_zero(slots_.size()));
    while (slots_[at] != kNone && slots_[at] != id) at = (at + 1) & last;
    return at;
  }
  void grow() {
    const std::vector<std::uint32_t> old = std::move(slots_);
    slots_.assign(std::max<std::size_t>(64, 2 * old.size()), kNone);
    for (const std::uint32_t id : old)
      if (id != kNone) slots_[slot_of(id)] = id;
  }

  std::vector<std::uint32_t> slots_;  // a power of two of them, no more than half full
  std::size_t count_ = 0;
};

}  // namespace divot::core
