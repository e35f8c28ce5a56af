#pragma once

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

#include "divot/errors.h"

namespace divot::meshfile {

/// Goes through a text line by line and word by word, without a copy.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {}

  /// On to the next line; false at the end.
  bool next() {
    if (text_.empty()) return false;
    const std::size_t end = text_.find('\n');
    line_ = text_.substr(0, end);
    text_.remove_prefix(end == text_.npos ? text_.size() : end + 1);
    ++number_;
    return true;
  }
  /// The next word of the line; empty where there is none.
  std::string_view word() {
    constexpr std::string_view kBlank = " \t\r";
    const std::size_t begin = line_.find_first_not_of(kBlank);
    if (begin == line_.npos) return line_ = {};
    const std::size_t end = std::min(line_.find_first_of(kBlank, begin), line_.size());
    const std::string_view found = line_.substr(begin, end - begin);
    line_.remove_prefix(end);
    return found;
  }
  int number() const { return number_; }  ///< of the line, 1-based
  /// Characters that no word() or next() has taken.
  std::size_t left() const { return line_.size() + text_.size(); }
  std::string_view rest() const { return text_; }  ///< what lies behind the line

 private:
  std::string_view text_, line_;
  int number_ = 0;
};

/// Reads the whole of `word` as a number.
template <class T>
bool parse(std::string_view word, T& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  return status == std::errc{} && end == word.data() + word.size();
}

inline tl::unexpected<Errors> refuse(const std::string& path, int line, std::string problem, std::string expected) {
  return fail({.file = path, .line = line, .problem = std::move(problem), .expected = std::move(expected)});
}

}  // namespace divot::meshfile
