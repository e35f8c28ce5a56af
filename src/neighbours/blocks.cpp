#include "neighbours/blocks.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>

#include "divot/ids.h"

namespace divot::neighbours {
namespace {

using state::Bonds;
constexpr std::uint32_t kLanes = Bonds::kLanes;
constexpr std::size_t kGrain = 256;
// What a slot costs in the force kernel, when its neighbours lie in one run, in two, and when they do not.
constexpr std::uint32_t kRunCost = 4, kTwoRunsCost = 5, kGatherCost = 10;

// Eight rows, or what is left of them at the end.
class Block {
 public:
  Block(const geometry::Rows& rows, std::size_t block) : begin_(block * kLanes), count_(rows.count()) {
    for (std::uint32_t lane = 0; lane < kLanes; ++lane)
      if (begin_ + lane < rows.count()) row_[lane] = rows.row(begin_ + lane);
  }

  std::size_t own(std::uint32_t lane) const { return std::min(begin_ + lane, count_ - 1); }

  // Calls f(lanes' neighbours, kNone where there is none; how they are read) for each slot of the k-th neighbours.
  template <class F>
  void for_each_kth(F f) const {
    std::size_t longest = 0;
    for (const auto& row : row_) longest = std::max(longest, row.size());
    for (std::size_t k = 0; k < longest; ++k) {
      std::array<std::uint32_t, kLanes> slot;
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) slot[lane] = k < row_[lane].size() ? row_[lane][k] : kNone;
      f(slot, state::find_reads(slot, count_));
    }
  }

  // The same for each slot of neighbours that stand alike: merges the rows by j - i. Ends when `goes_on()` says no.
  template <class F, class GoesOn>
  void for_each_alike(F f, GoesOn goes_on) const {
    constexpr std::int64_t kOver = std::numeric_limits<std::int64_t>::max();
    std::array<std::size_t, kLanes> head{};
    while (goes_on()) {
      std::int64_t step = kOver;
      for (std::uint32_t lane = 0; lane < kLanes; ++lane)
        if (head[lane] < row_[lane].size()) step = std::min(step, step_of(row_[lane][head[lane]], lane));
      if (step == kOver) return;
      std::array<std::uint32_t, kLanes> slot;
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        const bool alike = head[lane] < row_[lane].size() && step_of(row_[lane][head[lane]], lane) == step;
        slot[lane] = alike ? row_[lane][head[lane]++] : kNone;
      }
      f(slot, state::find_reads(slot, count_));
    }
  }

 private:
  std::int64_t step_of(std::uint32_t j, std::uint32_t lane) const {
    return static_cast<std::int64_t>(j) - static_cast<std::int64_t>(begin_ + lane);
  }

  std::size_t begin_;
  std::size_t count_;
  std::array<std::span<const std::uint32_t>, kLanes> row_;
};

struct Cost {
  std::uint32_t slots = 0, cost = 0;
  void operator()(const std::array<std::uint32_t, kLanes>&, const state::SlotReads& reads) {
    ++slots, cost += reads.run == kNone ? kGatherCost : reads.lanes == 0 ? kRunCost : kTwoRunsCost;
  }
};

struct Layout {
  bool alike = false;
  std::uint32_t slots = 0;
};

Layout cheapest(const Block& block) {
  Cost kth, alike;
  block.for_each_kth(std::ref(kth));
  block.for_each_alike(std::ref(alike), [&] { return alike.cost < kth.cost; });
  return alike.cost < kth.cost ? Layout{true, alike.slots} : Layout{false, kth.slots};
}

void fill(const Block& block, bool alike, const std::vector<std::uint8_t>& material, std::uint32_t slot,
          std::uint8_t& medium, Bonds& bonds) {
  medium = material[block.own(0)];
  const auto put = [&](const std::array<std::uint32_t, kLanes>& neighbours, const state::SlotReads& reads) {
    bonds.reads[slot] = reads;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const bool is_there = neighbours[lane] != kNone;
      const std::size_t entry = std::size_t{slot} * kLanes + lane;
      bonds.neighbour[entry] = is_there ? neighbours[lane] : static_cast<std::uint32_t>(block.own(lane));
      bonds.rest_length[entry] = is_there ? 0.0f : -1.0f;
      if (material[bonds.neighbour[entry]] != medium) medium = Bonds::kSeveral;
    }
    ++slot;
  };
  alike ? block.for_each_alike(put, [] { return true; }) : block.for_each_kth(put);
  for (std::uint32_t lane = 0; lane < kLanes; ++lane)
    if (material[block.own(lane)] != medium) medium = Bonds::kSeveral;
}

}  // namespace

void make_blocks(const geometry::Rows& rows, const std::vector<std::uint8_t>& material,
                 std::vector<std::uint32_t>& slots, Bonds& bonds, const Jobs& jobs) {
  const std::size_t blocks = (rows.count() + kLanes - 1) / kLanes;
  bonds.count = rows.count();
  slots.resize(blocks);
  // Two bits of a block's place in one number: how many slots it takes, and which layout.
  const auto measure = [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const Layout layout = cheapest(Block(rows, b));
      slots[b] = 2 * layout.slots + layout.alike;
    }
  };
  jobs.for_ranges(blocks, kGrain, std::ref(measure));

  bonds.first.resize(blocks + 1);
  bonds.first[0] = 0;
  for (std::size_t b = 0; b < blocks; ++b) bonds.first[b + 1] = bonds.first[b] + slots[b] / 2;
  const std::size_t slot_count = bonds.first[blocks];
  bonds.reads.resize(slot_count), bonds.medium.resize(blocks);
  bonds.neighbour.resize(slot_count * kLanes), bonds.rest_length.resize(slot_count * kLanes);
  const auto fill_all = [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b)
      fill(Block(rows, b), slots[b] % 2 == 1, material, bonds.first[b], bonds.medium[b], bonds);
  };
  jobs.for_ranges(blocks, kGrain, std::ref(fill_all));
}

}  // namespace divot::neighbours
