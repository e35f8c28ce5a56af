#pragma once

#include <osg/Group>

#include "viewer/lighting.h"
#include "viewer/look.h"
#include "viewer/shaders.h"

namespace divot::viewer {

/// What is drawn, before it is decided how.
struct Subjects {
  osg::Group& ground;
  osg::Group& walls;
  osg::Group& bodies;
  osg::Group& solids;  ///< those bodies that are no balls
  osg::Group& bombs;
};

/// The world in sunlight, before a sky.
class LitView {
 public:
  LitView(const Subjects& subjects, const Sun& sun, Quality quality);

  /// Whether the ground shows the number that `color_by` asks for, and whether its triangles are as small as pixels.
  void set_style(bool numbers, bool dense);

  osg::Group& root() { return *root_; }
  Lighting& lighting() { return lighting_; }

 private:
  GroundStyle style_;
  osg::ref_ptr<osg::Group> ground_;
  osg::ref_ptr<osg::Group> root_;
  Lighting lighting_;
};

}  // namespace divot::viewer
