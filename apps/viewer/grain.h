#pragma once

#include <osg/Texture2D>

namespace divot::viewer {

/// Noise that tiles, for shaders that cannot afford to compute it: octaves of broad waves (luminance) and of fine ones
/// (alpha), 0 to 1, about 0.5 on average.
osg::ref_ptr<osg::Texture2D> make_grain();

}  // namespace divot::viewer
