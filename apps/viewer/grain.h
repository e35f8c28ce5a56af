#pragma once

#include <osg/Texture2D>

namespace divot::viewer {

/// Octaves of noise that tile, for shaders that cannot afford to compute them: 0 to 1, about 0.5 on average.
osg::ref_ptr<osg::Texture2D> make_grain();

}  // namespace divot::viewer
