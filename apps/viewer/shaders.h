#pragma once

#include <osg/Program>

#include "viewer/look.h"

namespace divot::viewer {

/// Most bodies that darken the ground beneath them; the largest are taken.
inline constexpr int kMaxOccluders = 16;

/// Most bodies that throw shadows by formula, where the quality is fast; the largest are taken. Programs have a define
/// BALLS with their number.
inline constexpr int kMaxBallShadows = 6;

/// Texture unit of a material's picture.
inline constexpr unsigned kSoilUnit = 3;

// The programs of the picture, GLSL 1.30 with OpenGL's compatibility built-ins. Positions in them are the surface's, in
// metres relative to its origin. What their uniforms mean stands with the uniforms in lighting.h and scene_graph.cpp.

/// Which of its programs colours the ground.
struct GroundStyle {
  Quality quality = Quality::fine;
  bool numbers = false;  ///< by the number that `color_by` asks for, instead of naturally
  bool dense = false;    ///< triangles are about as small as pixels: fast quality then works at vertices only
  friend bool operator==(const GroundStyle&, const GroundStyle&) = default;
};

/// Terrain coloured by slope, height and disturbance, or by a number.
osg::ref_ptr<osg::Program> ground_program(const GroundStyle& style);
osg::ref_ptr<osg::Program> wall_program(Quality quality);        ///< the cut through the soil where the terrain ends
osg::ref_ptr<osg::Program> ball_program(Quality quality);        ///< spheres: bodies with a pattern that shows rolling
osg::ref_ptr<osg::Program> depth_program();                      ///< what the sun sees
osg::ref_ptr<osg::Program> background_program(Quality quality);  ///< gradient behind everything
osg::ref_ptr<osg::Program> ink_program();      ///< one colour without light: lines and fillings of the wireframe
osg::ref_ptr<osg::Program> point_program();    ///< points and lines without light
osg::ref_ptr<osg::Program> puff_program();     ///< dust and flashes
osg::ref_ptr<osg::Program> stretch_program();  ///< a picture, texture unit `picture`, over all of the viewport

}  // namespace divot::viewer
