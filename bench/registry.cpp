#include "bench/bench.h"
#ifdef DIVOT_HAS_VIEWER
#include "bench/upload.h"
#include "bench/view.h"
#endif

namespace divot::bench {

std::span<const Bench> benches() {
  static constexpr Bench kBenches[] = {
      {"figure1", "parts of a step by update policy, the paper's Figure 1", &figure1},
      {"scaling", "a step with every particle awake, by particles and threads", &scaling},
      {"terrain_size", "the same crater on more and more ground", &terrain_size},
      {"refinement", "error and cost by triangles, uniform and where the ground deforms", &refinement},
      {"bodies", "rolling balls and bombs by their number", &bodies},
      {"rolling", "spheres on soft soil, beside Chrono's SCM terrain", &rolling},
      {"peers", "the same work by LAMMPS, nanoflann, Embree and Bullet", &peers},
#ifdef DIVOT_HAS_VIEWER
      {"upload", "bytes and time of pictures by what is sent for them", &upload},
      {"view", "pictures a second of the window", &view}
#endif
  };
  return kBenches;
}

}  // namespace divot::bench
