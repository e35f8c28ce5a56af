#pragma once

#include <string>
#include <utility>

#include "divot/errors.h"

namespace divot::viewer {

/// A failed Result that has no line: what is wrong, what would be right, and the key or file it is about where there is
/// one.
inline tl::unexpected<Errors> failure(std::string problem, std::string expected, std::string key = {},
                                      std::string file = {}) {
  Error error;
  error.file = std::move(file);
  error.key = std::move(key);
  error.problem = std::move(problem);
  error.expected = std::move(expected);
  return fail(std::move(error));
}

}  // namespace divot::viewer
