#pragma once

#include <osg/StateSet>
#include <osg/Texture2D>
#include <span>
#include <string>
#include <vector>

#include "divot/errors.h"
#include "divot/material.h"

namespace divot::viewer {

/// `#rrggbb` as numbers, 0 to 1; white where it is something else.
osg::Vec3 color_of(const std::string& text);

/// The picture of a material, or null where it has none. `folder`: where relative paths start.
osg::ref_ptr<osg::Texture2D> texture_of(const Material& material, const std::string& folder);

/// State for the ground's programs, [material]: what it is coloured with, and which of the scale's colours is its. One
/// for every number that a surface can name, whether it is in `materials` or not.
std::vector<osg::ref_ptr<osg::StateSet>> soil_looks(std::span<const Material> materials, const std::string& folder);

}  // namespace divot::viewer
