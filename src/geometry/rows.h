#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace divot::geometry {

/// Neighbours of particles, in compressed rows. Row i holds every j != i whose squared distance, computed in float as
/// (dx*dx + dy*dy) + dz*dz, is at most the squared radius; ascending. Any structure that makes them makes the same.
struct Rows {
  std::vector<std::uint32_t> start;  ///< [count + 1] row i is index[start[i]] .. index[start[i + 1] - 1]
  std::vector<std::uint32_t> index;  ///< [pair] particles; each pair is there twice, once from either side

  std::size_t count() const { return start.empty() ? 0 : start.size() - 1; }
  std::span<const std::uint32_t> row(std::size_t i) const {
    return std::span(index).subspan(start[i], start[i + 1] - start[i]);
  }
};

}  // namespace divot::geometry
