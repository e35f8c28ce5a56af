#pragma once

#include "cli/progress.h"
#include "divot/world.h"
#include "viewer/renderer.h"

namespace divot::cli {

/// A world that is drawn on its way.
class Filming {
 public:
  /// Shows `renderer` the world at its start, so that the view is the same whichever pictures are asked for. Both must
  /// outlive it.
  Filming(World& world, viewer::Renderer& renderer);

  /// Steps to the step nearest to `time` (s) and draws; call it in ascending order. Fails when the driver does; when
  /// interrupted() the picture is of no use.
  Result<viewer::Image> picture_at(double time, bool wireframe);

  /// A line on stdout, in the place of the line of progress.
  void say(const std::string& text);

 private:
  World& world_;
  viewer::Renderer& renderer_;
  Progress progress_;
};

}  // namespace divot::cli
