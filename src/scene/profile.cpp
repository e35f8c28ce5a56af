#include <algorithm>

#include "divot/joint.h"

namespace divot {

double Profile::at(double time) const {
  if (points.empty()) return 0;
  const auto after = std::upper_bound(points.begin(), points.end(), time,
                                      [](double t, const std::pair<double, double>& p) { return t < p.first; });
  if (after == points.begin()) return points.front().second;
  if (after == points.end()) return points.back().second;
  const auto& [t0, v0] = *(after - 1);
  const auto& [t1, v1] = *after;
  return v0 + (v1 - v0) * (time - t0) / (t1 - t0);
}

}  // namespace divot
