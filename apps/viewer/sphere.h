#pragma once

#include <osg/Node>

namespace divot::viewer {

/// A unit sphere around the origin, with fewer triangles where it covers few pixels. Share one among all balls.
osg::ref_ptr<osg::Node> make_sphere();

/// A unit sphere of meridians and parallels, coarse enough for its edges to be drawn as lines.
osg::ref_ptr<osg::Node> make_line_sphere();

}  // namespace divot::viewer
