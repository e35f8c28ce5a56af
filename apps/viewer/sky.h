#pragma once

#include <osg/Geometry>

#include "viewer/look.h"

namespace divot::viewer {

/// What is behind everything: a gradient for pictures, plain paper for line drawings. Fills the window whatever the
/// camera looks at.
osg::ref_ptr<osg::Geometry> make_background(const osg::Vec3& top, const osg::Vec3& bottom, Quality quality);

}  // namespace divot::viewer
