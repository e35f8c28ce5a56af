#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "divot/ids.h"

namespace divot::core {

/// A set of small numbers that is filled and emptied again and again: a bit for each, and one for each word of them.
/// Lists them ascending without sorting. Grows to the highest it ever held and stays.
class IdSet {
 public:
  /// [O(1), amortized]
  void insert(std::uint32_t id) {
    const std::size_t word = id / 64;
    if (word >= words_.size()) grow(word);
    words_[word] |= std::uint64_t{1} << (id % 64);
    filled_[word / 64] |= std::uint64_t{1} << (word % 64);
  }

  /// [O(1)]
  bool contains(std::uint32_t id) const {
    const std::size_t word = id / 64;
    return word < words_.size() && (words_[word] >> (id % 64) & 1);
  }

  /// Takes a number out, if it is there. [O(1)]
  void erase(std::uint32_t id) {
    const std::size_t word = id / 64;
    if (word < words_.size()) words_[word] &= ~(std::uint64_t{1} << (id % 64));
  }

  /// Empties the set into `list`, ascending; what the list held is gone. [O(ids + highest / 4096)]
  void drain(std::vector<std::uint32_t>& list) {
    list.clear();
    for_each_word([&](std::size_t word) {
      append(word, list);
      words_[word] = 0;
    });
    std::fill(filled_.begin(), filled_.end(), 0);
  }

  /// Lists the set ascending into `list` and lets index_of() find where in it an id is; the set stays as it is.
  void list(std::vector<std::uint32_t>& list) {
    list.clear();
    first_.resize(words_.size());
    for_each_word([&](std::size_t word) {
      first_[word] = static_cast<std::uint32_t>(list.size());
      append(word, list);
    });
  }

  /// Index of an id in the last list(), kNone where it is not in it. Nothing may have been inserted since. [O(1)]
  std::uint32_t index_of(std::uint32_t id) const {
    const std::size_t word = id / 64;
    const std::uint64_t bit = std::uint64_t{1} << (id % 64);
    if (word >= words_.size() || !(words_[word] & bit)) return kNone;
    return first_[word] + static_cast<std::uint32_t>(std::popcount(words_[word] & (bit - 1)));
  }

  /// Empties the set. [O(ids / 64 + highest / 4096)]
  void clear() {
    for_each_word([&](std::size_t word) { words_[word] = 0; });
    std::fill(filled_.begin(), filled_.end(), 0);
  }

  /// Sorts a list and leaves each of its numbers once; the set must be empty and is so again.
  void sort_unique(std::vector<std::uint32_t>& list) {
    for (const std::uint32_t id : list) insert(id);
    drain(list);
  }

 private:
  template <class F>
  void for_each_word(F f) const {
    for (std::size_t group = 0; group < filled_.size(); ++group)
      for (std::uint64_t left = filled_[group]; left != 0; left &= left - 1)
        f(64 * group + static_cast<std::size_t>(std::countr_zero(left)));
  }
  void append(std::size_t word, std::vector<std::uint32_t>& list) const {
    for (std::uint64_t left = words_[word]; left != 0; left &= left - 1)
      list.push_back(static_cast<std::uint32_t>(64 * word) + static_cast<std::uint32_t>(std::countr_zero(left)));
  }
  void grow(std::size_t word) {
    words_.resize(word + word / 2 + 64, 0);
    filled_.resize(words_.size() / 64 + 1, 0);
  }

  std::vector<std::uint64_t> words_;   // [id / 64]
  std::vector<std::uint64_t> filled_;  // [id / 4096] which words are not zero
  std::vector<std::uint32_t> first_;   // [id / 64] index in the last list()
};

}  // namespace divot::core
