#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "divot/ids.h"

namespace divot::geometry {

/// A list of ids of which parts follow from a rule that its owner knows, and take no memory for as long as nobody
/// writes there.
class PagedIds {
 public:
  /// All of them stored.
  void assign(std::vector<std::uint32_t> ids) {
    size_ = ids.size(), stored_ = std::move(ids);
    stored_.resize((size_ + kPage - 1) / kPage * kPage, kNone);
    page_.resize(stored_.size() / kPage);
    for (std::size_t page = 0; page < page_.size(); ++page) page_[page] = static_cast<std::uint32_t>(page);
  }
  /// All of them by the rule.
  void imply(std::size_t size) {
    size_ = size, stored_.clear();
    page_.assign((size + kPage - 1) / kPage, kNone);
  }
  /// Memory for so many, if those so far are stored.
  void reserve(std::size_t size) {
    page_.reserve(size / kPage + 1);
    if (!stored_.empty()) stored_.reserve(size + kPage);
  }

  std::size_t size() const { return size_; }
  bool follows_rule(std::uint32_t i) const { return page_[i / kPage] == kNone; }
  /// Only where it does not follow the rule.
  std::uint32_t operator[](std::uint32_t i) const { return stored_[std::size_t{page_[i / kPage]} * kPage + i % kPage]; }

  /// Writes one; those beside it are stored from now on too, as `rule(i)` says. [O(1)]
  template <class Rule>
  void set(std::uint32_t i, std::uint32_t id, const Rule& rule) {
    if (follows_rule(i)) store_page(i / kPage, rule);
    stored_[std::size_t{page_[i / kPage]} * kPage + i % kPage] = id;
  }
  template <class Rule>
  void push_back(std::uint32_t id, const Rule& rule) {
    const auto i = static_cast<std::uint32_t>(size_);
    if (i / kPage == page_.size()) {
      page_.push_back(static_cast<std::uint32_t>(stored_.size() / kPage));
      stored_.resize(stored_.size() + kPage, kNone);
    }
    if (follows_rule(i)) store_page(i / kPage, rule);
    ++size_;
    set(i, id, rule);
  }
  /// Drops the last.
  void shrink(std::size_t size) { size_ = size; }

 private:
  static constexpr std::uint32_t kPage = 256;

  template <class Rule>
  void store_page(std::uint32_t page, const Rule& rule) {
    const std::size_t first = stored_.size();
    stored_.resize(first + kPage, kNone);
    for (std::uint32_t k = 0; k < kPage && std::size_t{page} * kPage + k < size_; ++k)
      stored_[first + k] = rule(page * kPage + k);
    page_[page] = static_cast<std::uint32_t>(first / kPage);
  }

  std::size_t size_ = 0;
  std::vector<std::uint32_t> page_;    // [i / kPage] where it is in stored_; kNone: it follows the rule
  std::vector<std::uint32_t> stored_;  // page by page
};

}  // namespace divot::geometry
