#include "validation/case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace divot::validation {
namespace {

// Rounding of the middle and the half width must not decide.
constexpr double kRounding = 1e-12;

}  // namespace

Case between(Case what, double low, double high) {
  what.bound = Bound::between;
  what.measured = 0.5 * (low + high);
  what.tolerance = (high - low) / (high + low);
  return what;
}

double range_low(const Case& one) { return one.measured * (1 - one.tolerance); }
double range_high(const Case& one) { return one.measured * (1 + one.tolerance); }

double relative_error(const Case& one, double simulated) {
  if (std::isnan(simulated)) return simulated;
  const double over = (simulated - one.measured) / std::abs(one.measured);
  switch (one.bound) {
    case Bound::at_most:
      return std::max(0.0, over);
    case Bound::at_least:
      return std::max(0.0, -over);
    default:
      return std::abs(over);
  }
}

bool passes(const Case& one, double simulated) { return relative_error(one, simulated) <= one.tolerance + kRounding; }

std::string measured_text(const Case& one) {
  switch (one.bound) {
    case Bound::about:
      return fmt::format("{:.4g}", one.measured);
    case Bound::between:
      return fmt::format("{:.3g} to {:.3g}", range_low(one), range_high(one));
    case Bound::at_most:
      return fmt::format("< {:.3g}", one.measured);
    case Bound::at_least:
      return fmt::format("> {:.3g}", one.measured);
  }
  return {};
}

}  // namespace divot::validation
