#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/assert.h"
#include "divot/ids.h"
#include "divot/jobs.h"
#include "geometry/rows.h"

namespace divot::geometry {

/// Consecutive rows that one thread finds, one after the other in memory.
class RowChunk {
 public:
  /// Room for `count` entries behind what is there. Valid until the next call.
  std::uint32_t* room(std::size_t count) {
    if (used_ + count > entries_.size()) entries_.resize(2 * (used_ + count));
    return entries_.data() + used_;
  }
  /// The first `count` entries of the room are now a row; sorts them.
  void close_row(std::size_t count) {
    sort(entries_.data() + used_, count);
    used_ += count;
  }
  void clear() { used_ = 0; }
  std::size_t size() const { return used_; }
  const std::uint32_t* data() const { return entries_.data(); }

 private:
  // Most rows have about ten entries, for which insertion is enough.
  static void sort(std::uint32_t* row, std::size_t count) {
    constexpr std::size_t kShort = 32;
    if (count > kShort) return std::sort(row, row + count);
    for (std::size_t i = 1; i < count; ++i) {
      const std::uint32_t value = row[i];
      std::size_t at = i;
      for (; at > 0 && row[at - 1] > value; --at) row[at] = row[at - 1];
      row[at] = value;
    }
  }

  std::vector<std::uint32_t> entries_;
  std::size_t used_ = 0;
};

/// Finds rows in parallel, chunk by chunk, and puts the chunks together: each distance is computed once, which a pass
/// to count and a pass to fill would do twice. Keeps its memory.
class RowGatherer {
 public:
  /// Calls `find(i, chunk)` for each of `count` rows; it writes the neighbours of i, in any order, to chunk.room() and
  /// returns how many. Fewer than 2^32 neighbours in all.
  template <class Find>
  void gather(std::size_t count, const Jobs& jobs, const Find& find, Rows& rows) {
    // Chunks are cut by count alone, never by threads.
    const std::size_t chunk_count = (count + kRowsPerChunk - 1) / kRowsPerChunk;
    if (chunks_.size() < chunk_count) chunks_.resize(chunk_count);
    rows.start.resize(count + 1);
    const auto find_rows = [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) {
        chunks_[c].clear();
        for (std::size_t i = c * kRowsPerChunk; i < std::min(count, (c + 1) * kRowsPerChunk); ++i) {
          rows.start[i] = static_cast<std::uint32_t>(chunks_[c].size());
          chunks_[c].close_row(find(i, chunks_[c]));
        }
      }
    };
    // By reference: a copy in std::function would be an allocation.
    jobs.for_ranges(chunk_count, 1, std::ref(find_rows));
    join(count, chunk_count, jobs, rows);
  }

 private:
  static constexpr std::size_t kRowsPerChunk = 1024;

  void join(std::size_t count, std::size_t chunk_count, const Jobs& jobs, Rows& rows) {
    first_.resize(chunk_count + 1);
    first_[0] = 0;
    for (std::size_t c = 0; c < chunk_count; ++c) first_[c + 1] = first_[c] + chunks_[c].size();
    DIVOT_ASSERT(first_[chunk_count] < kNone);
    rows.index.resize(first_[chunk_count]);
    rows.start[count] = static_cast<std::uint32_t>(first_[chunk_count]);
    const auto copy_rows = [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) {
        std::copy_n(chunks_[c].data(), chunks_[c].size(), rows.index.begin() + first_[c]);
        for (std::size_t i = c * kRowsPerChunk; i < std::min(count, (c + 1) * kRowsPerChunk); ++i)
          rows.start[i] += static_cast<std::uint32_t>(first_[c]);
      }
    };
    jobs.for_ranges(chunk_count, 8, std::ref(copy_rows));
  }

  std::vector<RowChunk> chunks_;
  std::vector<std::size_t> first_;  // [chunk + 1] where its entries go
};

}  // namespace divot::geometry
