#include "geometry/column_grid.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/assert.h"

namespace divot::geometry {
namespace {

constexpr std::size_t kGrain = 1 << 14;  // particles a thread takes at a time
constexpr std::uint32_t kDigitBits = 11;

// Width of a column for a radius and the extent of all particles. A trifle is added so that neither rounding nor
// underflow of the float distance can make neighbours of particles two columns apart; and column numbers fit 31 bits.
double column_width(double radius, double extent) {
  return std::max(radius * (1 + 1e-6) + 1e-15, extent / 2147483000.0);
}

}  // namespace

void ColumnGrid::build(std::span<const float> x, std::span<const float> y, std::span<const float> z) {
  DIVOT_ASSERT(x.size() == y.size() && x.size() == z.size() && x.size() < kNone);
  x_ = x, y_ = y, z_ = z;
  low_x_ = high_x_ = x.empty() ? 0 : x[0];
  low_y_ = high_y_ = y.empty() ? 0 : y[0];
  for (std::size_t i = 0; i < x.size(); ++i) {
    low_x_ = std::min(low_x_, x[i]), high_x_ = std::max(high_x_, x[i]);
    low_y_ = std::min(low_y_, y[i]), high_y_ = std::max(high_y_, y[i]);
  }
}

void ColumnGrid::place_in_columns(float radius, const Jobs& jobs) {
  // In double: in float, column numbers in the thousands would be wrong by their own rounding.
  const double x0 = low_x_, y0 = low_y_;
  const double extent = std::max(high_x_ - x0, high_y_ - y0), inverse = 1 / column_width(radius, extent);
  column_x_.resize(x_.size()), column_y_.resize(x_.size());
  const auto place = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      column_x_[i] = static_cast<std::uint32_t>(static_cast<std::int32_t>((x_[i] - x0) * inverse));
      column_y_[i] = static_cast<std::uint32_t>(static_cast<std::int32_t>((y_[i] - y0) * inverse));
    }
  };
  jobs.for_ranges(x_.size(), kGrain, std::ref(place));
}

// Stable counting sort of order_ by `key`, digit by digit; as many digits as the largest key has.
void ColumnGrid::sort_by(const std::vector<std::uint32_t>& key) {
  const std::uint32_t largest = key.empty() ? 0 : *std::max_element(key.begin(), key.end());
  sorted_.resize(order_.size());
  for (std::uint32_t shift = 0; shift < 32 && largest >> shift > 0; shift += kDigitBits) {
    const std::uint32_t mask = (1u << kDigitBits) - 1;
    places_.assign(std::size_t{mask} + 2, 0);
    for (const std::uint32_t i : order_) ++places_[(key[i] >> shift & mask) + 1];
    for (std::size_t digit = 1; digit < places_.size(); ++digit) places_[digit] += places_[digit - 1];
    for (const std::uint32_t i : order_) sorted_[places_[key[i] >> shift & mask]++] = i;
    order_.swap(sorted_);
  }
}

// One column for each run of slots with equal numbers, and a last one of no particles to end the list.
void ColumnGrid::find_columns() {
  columns_.clear();
  column_of_.resize(order_.size());
  for (std::uint32_t slot = 0; slot < order_.size(); ++slot) {
    const std::uint32_t i = order_[slot], x = column_x_[i], y = column_y_[i];
    if (columns_.empty() || columns_.back().x != x || columns_.back().y != y) columns_.push_back({x, y, slot, {}, {}});
    column_of_[i] = static_cast<std::uint32_t>(columns_.size() - 1);
  }
  columns_.push_back({kNone, kNone, static_cast<std::uint32_t>(order_.size()), {}, {}});
}

// Columns x - 1 to x + 1 of one y lie side by side. Six marks, the begin and end of each range, walk along the sorted
// columns and never turn back.
void ColumnGrid::join_columns() {
  const auto before = [](const Column& c, std::int64_t x, std::int64_t y) { return c.y < y || (c.y == y && c.x < x); };
  std::array<std::size_t, 3> begin{}, end{};
  for (std::size_t c = 0; c + 1 < columns_.size(); ++c) {
    const std::int64_t x = columns_[c].x, y = columns_[c].y;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t row = y + static_cast<std::int64_t>(k) - 1;
      while (before(columns_[begin[k]], x - 1, row)) ++begin[k];
      end[k] = std::max(begin[k], end[k]);
      while (before(columns_[end[k]], x + 2, row)) ++end[k];
      columns_[c].begin[k] = columns_[begin[k]].first, columns_[c].end[k] = columns_[end[k]].first;
    }
  }
}

void ColumnGrid::copy_to_slots(const Jobs& jobs) {
  for (std::vector<float>* slots : {&slot_x_, &slot_y_, &slot_z_}) slots->resize(order_.size());
  const auto copy = [this](std::size_t begin, std::size_t end) {
    for (std::size_t slot = begin; slot < end; ++slot) {
      const std::uint32_t i = order_[slot];
      slot_x_[slot] = x_[i], slot_y_[slot] = y_[i], slot_z_[slot] = z_[i];
    }
  };
  jobs.for_ranges(order_.size(), kGrain, std::ref(copy));
}

std::size_t ColumnGrid::find_row(std::size_t i, float radius_squared, RowChunk& chunk) const {
  const Column& column = columns_[column_of_[i]];
  const float x = x_[i], y = y_[i], z = z_[i];
  std::size_t candidates = 0, found = 0;
  for (std::size_t k = 0; k < 3; ++k) candidates += column.end[k] - column.begin[k];
  std::uint32_t* row = chunk.room(candidates + 1);

  // Each candidate is written, and the next overwrites it unless it is near enough, so that nothing branches. Distances
  // in blocks of vector lanes were tried: ranges are as short as the lanes, and it gained nothing.
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t slot = column.begin[k]; slot < column.end[k]; ++slot) {
      const float dx = slot_x_[slot] - x, dy = slot_y_[slot] - y, dz = slot_z_[slot] - z;
      const std::uint32_t j = order_[slot];
      const bool near = (dx * dx + dy * dy) + dz * dz <= radius_squared;
      row[found] = j;
      found += static_cast<std::size_t>(near) & static_cast<std::size_t>(j != i);
    }
  }
  return found;
}

void ColumnGrid::rows(float radius, Rows& rows, const Jobs& jobs) {
  DIVOT_ASSERT(radius >= 0);
  place_in_columns(radius, jobs);
  order_.resize(x_.size());
  for (std::uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
  sort_by(column_x_);
  sort_by(column_y_);
  find_columns();
  join_columns();
  copy_to_slots(jobs);
  const float radius_squared = radius * radius;
  const auto find = [&](std::size_t i, RowChunk& chunk) { return find_row(i, radius_squared, chunk); };
  gatherer_.gather(x_.size(), jobs, find, rows);
}

}  // namespace divot::geometry
