#pragma once

#include <string>

namespace divot::validation {

/// How a simulated value has to stand to the measured one.
enum class Bound {
  about,    ///< within `tolerance` of it
  between,  ///< in a range, of which `measured` is the middle and `tolerance` half the width over the middle
  at_most,  ///< `measured` is a limit
  at_least,
};

/// One comparison: what a source says, and how near the simulation has to come.
struct Case {
  std::string name;    ///< `family/what`, without spaces
  std::string source;  ///< who says so
  std::string quantity;
  std::string unit;      ///< `1` for a bare number
  double measured = 0;   ///< what the source says; not zero where `bound` is about
  double tolerance = 0;  ///< relative; 0 for limits
  Bound bound = Bound::about;
};

/// A case whose source gives a range.
Case between(Case what, double low, double high);

/// Ends of the range of a case that is `between`.
double range_low(const Case& one);
double range_high(const Case& one);

/// How far `simulated` is from what the case says, relative to it: for limits, how far beyond. Not a number stays so.
double relative_error(const Case& one, double simulated);

/// Whether the case holds. What is not a number never does.
bool passes(const Case& one, double simulated);

/// The measured side in words: `0.149`, `0.15 to 0.3`, `< 0.001`.
std::string measured_text(const Case& one);

}  // namespace divot::validation
