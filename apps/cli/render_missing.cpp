#include <fmt/format.h>

#include "cli/commands.h"

namespace divot::cli {

int render(const RenderOptions&) {
  fmt::print(stderr, "divot render: this build has no renderer; configure it with -DDIVOT_VIEWER=ON\n");
  return kBadInput;
}

int view(const ViewOptions&) {
  fmt::print(stderr, "divot view: this build has no window; configure it with -DDIVOT_VIEWER=ON\n");
  return kBadInput;
}

}  // namespace divot::cli
