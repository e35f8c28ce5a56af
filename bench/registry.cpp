#include "bench/bench.h"

namespace divot::bench {

std::span<const Bench> benches() {
  static constexpr Bench kBenches[] = {{"figure1", "parts of a step by update policy, the paper's Figure 1", &figure1}};
  return kBenches;
}

}  // namespace divot::bench
