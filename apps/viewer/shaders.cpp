#include "viewer/shaders.h"

#include <string>

#include "viewer/color_scale.h"
#include "viewer/glsl_fast_ground.h"
#include "viewer/glsl_ground.h"
#include "viewer/glsl_light.h"
#include "viewer/glsl_objects.h"
#include "viewer/terrain_chunk.h"

namespace divot::viewer {
namespace {

static_assert(kMaxOccluders == 16, "the length of `occluders` in glsl_light.h and glsl_fast_ground.h");
static_assert(kMaxBallShadows == 6, "the length of `ball_shadows` there");
static_assert(kScaleStops == 5, "the length of `ramp` in glsl_ground.h");

const std::string kVersion = "#version 130\n";

// What states set for the ground: how many balls throw shadows, and what its material is coloured with.
const std::string kSoilDefines = "#pragma import_defines(BALLS, SOIL_COLOR, SOIL_TEXTURE)\n";

osg::ref_ptr<osg::Program> make_program(const std::string& vertex, const std::string& fragment) {
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
  program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment));
  program->addBindAttribLocation("sinkage", kSinkageAttribute);
  program->addBindAttribLocation("mark", kMarkAttribute);
  return program;
}

// The functions that light what is not the fast ground, which has its own.
std::string light(Quality quality) {
  const bool fast = quality == Quality::fast;
  return std::string(glsl::kLightUniforms) + glsl::kLitPlace + (fast ? glsl::kFastSunlight : glsl::kFineSunlight) +
         glsl::kOpenness + (fast ? glsl::kFastDevelop : glsl::kDevelop) + glsl::kShade;
}

}  // namespace

osg::ref_ptr<osg::Program> ground_program(const GroundStyle& style) {
  // Many programs and not one with branches: software renderers take both sides of branches.
  std::string head = kVersion;
  if (style.numbers) head += "#define NUMBERS\n";
  if (style.dense && style.quality == Quality::fast) head += "#define DENSE\n";
  const std::string vertex = head + glsl::kShownNumber;
  if (style.quality == Quality::fast) {
    const std::string color =
        kSoilDefines + std::string(glsl::kFastDevelop) + glsl::kRamp + glsl::kSoil + glsl::kFastGroundColor;
    return make_program(vertex + color + glsl::kOpenness + glsl::kFastGroundVertex,
                        head + color + glsl::kFastGroundFragment);
  }
  return make_program(vertex + glsl::kGroundVertex, head + kSoilDefines + light(style.quality) + glsl::kNoise +
                                                        glsl::kRamp + glsl::kSoil + glsl::kGroundFragment);
}

osg::ref_ptr<osg::Program> wall_program(Quality quality) {
  const std::string body =
      quality == Quality::fast ? std::string(glsl::kFastWallFragment) : std::string(glsl::kNoise) + glsl::kWallFragment;
  return make_program(kVersion + glsl::kShownNumber + glsl::kGroundVertex, kVersion + light(quality) + body);
}

osg::ref_ptr<osg::Program> ball_program(Quality quality) {
  if (quality == Quality::fast) {
    return make_program(kVersion + glsl::kLightUniforms + glsl::kFastSunlight + glsl::kFastBallVertex,
                        kVersion + glsl::kFastDevelop + glsl::kBallPattern + glsl::kFastBallFragment);
  }
  return make_program(glsl::kBallVertex, kVersion + light(quality) + glsl::kBallPattern + glsl::kBallFragment);
}

osg::ref_ptr<osg::Program> depth_program() { return make_program(glsl::kDepthVertex, glsl::kDepthFragment); }
osg::ref_ptr<osg::Program> background_program(Quality quality) {
  const std::string head = kVersion + (quality == Quality::fine ? "#define DITHER\n" : "");
  return make_program(glsl::kBackgroundVertex, head + glsl::kBackgroundFragment);
}
osg::ref_ptr<osg::Program> ink_program() {
  return make_program(kVersion + glsl::kShownNumber + glsl::kRamp + glsl::kInkVertex, glsl::kInkFragment);
}
osg::ref_ptr<osg::Program> point_program() { return make_program(glsl::kPointVertex, glsl::kTintFragment); }
osg::ref_ptr<osg::Program> stretch_program() { return make_program(glsl::kStretchVertex, glsl::kStretchFragment); }
osg::ref_ptr<osg::Program> puff_program() { return make_program(glsl::kPuffVertex, glsl::kPuffFragment); }

}  // namespace divot::viewer
