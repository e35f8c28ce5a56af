#pragma once

#include <osg/Node>

#include "divot/shape.h"

namespace divot::viewer {

/// A shape in its own axes, m: of quadrangles where it can be, so that its edges can be drawn without diagonals. What
/// is round shows by its pattern that it rolls. `ball`: a unit sphere for the balls in it. Hulls need their triangles,
/// as a BodyView has them. [O(corners)]
osg::ref_ptr<osg::Node> make_shape(const Shape& shape, osg::Node& ball);

}  // namespace divot::viewer
