#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "divot/jobs.h"
#include "geometry/row_gatherer.h"
#include "geometry/rows.h"

namespace divot::geometry {

/// Neighbours by a grid of columns over x and y, as wide as the radius. A surface is thin, so that z needs no cells.
/// Only columns with particles exist, found by sorting: memory follows the particles, however far apart they lie.
/// Keeps its memory: once warm, nothing allocates.
class ColumnGrid {
 public:
  /// Takes particles at x, y, z ([particle] m, finite). The spans must stay valid and unchanged until the last rows().
  /// [O(particles)]
  void build(std::span<const float> x, std::span<const float> y, std::span<const float> z);

  /// Writes the neighbours of every particle within `radius` (m, >= 0). Bits do not depend on the number of threads.
  /// [O(particles + pairs within about twice the radius)]
  void rows(float radius, Rows& rows, const Jobs& jobs);

 private:
  // A column that has particles, and the slots of the three by three columns round it: one range for each of three y.
  struct Column {
    std::uint32_t x = 0, y = 0;
    std::uint32_t first = 0;  // slot of its first particle
    std::array<std::uint32_t, 3> begin{}, end{};
  };

  void place_in_columns(float radius, const Jobs& jobs);
  void sort_by(const std::vector<std::uint32_t>& key);
  void find_columns();
  void join_columns();
  void copy_to_slots(const Jobs& jobs);
  std::size_t find_row(std::size_t i, float radius_squared, RowChunk& chunk) const;

  std::span<const float> x_, y_, z_;
  float low_x_ = 0, low_y_ = 0, high_x_ = 0, high_y_ = 0;  // bounds, m
  std::vector<std::uint32_t> column_x_, column_y_;         // [particle] its column
  std::vector<std::uint32_t> order_, sorted_;              // [slot] particle, by column and then ascending
  std::vector<std::uint32_t> places_;                      // [digit] scratch of sort_by
  std::vector<float> slot_x_, slot_y_, slot_z_;            // [slot] m
  std::vector<Column> columns_;                            // by y, then x
  std::vector<std::uint32_t> column_of_;                   // [particle] index into columns_
  RowGatherer gatherer_;
};

}  // namespace divot::geometry
