#include "divot/errors.h"

#include <fmt/format.h>

namespace divot {

std::string Error::text() const {
  std::string out = file;
  if (line > 0) out += fmt::format(":{}", line);
  if (!out.empty()) out += ": ";
  if (!key.empty()) out += key + ": ";
  out += problem;
  if (!expected.empty()) out += "; " + expected;
  return out;
}

}  // namespace divot
