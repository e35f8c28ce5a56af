#pragma once

#include "viewer/lit_view.h"

namespace divot::viewer {

/// The world as lines on paper, without those that are hidden. `subjects.bodies` should have edges worth drawing, see
/// make_line_sphere(). `cell`: uniform with the width of a mesh cell in m, by which lines far away fade.
osg::ref_ptr<osg::Group> make_line_view(const Subjects& subjects, osg::Uniform& cell);

}  // namespace divot::viewer
