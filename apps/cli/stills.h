#pragma once

#include <string>
#include <vector>

#include "cli/filming.h"
#include "cli/options.h"

namespace divot::cli {

/// A picture to be taken.
struct Shot {
  double time = 0;  ///< s
  bool wireframe = false;
};

/// The single pictures asked for, ascending, each time once. Fails when a time is not within the run or a wireframe not
/// among the pictures.
Result<std::vector<Shot>> plan_stills(const RenderOptions& options, const Scene& scene);

/// Draws `shots` into `folder` as NAME_tTIME.png, and with `sheet` all of them into NAME_sheet.png. Stops early when
/// interrupted(). Fails when a file cannot be written.
Result<void> draw_stills(Filming& filming, const std::vector<Shot>& shots, bool sheet, const std::string& folder,
                         const std::string& name);

}  // namespace divot::cli
