#pragma once

#include <string>
#include <tl/expected.hpp>
#include <vector>

namespace divot {

/// One thing that is wrong with an input: where it is, what it is and what would be right.
struct Error {
  std::string file = {};      ///< path as the user gave it; empty when there is no file
  int line = 0;               ///< 1-based; 0 when the problem has no line
  std::string key = {};       ///< dotted path of the scene key; empty when there is none
  std::string problem = {};   ///< what is wrong, in words
  std::string expected = {};  ///< what would be right, in words; may be empty

  /// `file:line: key: problem; expected`, leaving out what is empty.
  std::string text() const;
};

/// Every problem found, in the order of the file. Never empty where it stands for a failure.
using Errors = std::vector<Error>;

/// A value, or everything that is wrong with the input it should have come from.
template <class T>
using Result = tl::expected<T, Errors>;

/// A failed Result from a single error.
inline tl::unexpected<Errors> fail(Error error) { return tl::unexpected<Errors>(Errors{std::move(error)}); }

}  // namespace divot
