#include "viewer/shaders.h"

#include <string>

#include "viewer/terrain_chunk.h"

namespace divot::viewer {
namespace {

// Sun, sky, shadows and haze: shared by everything that is lit. Varyings are taken inside the triangle (centroid):
// extrapolated to a pixel's middle outside of it they would sprinkle dark dots along ridges.
constexpr char kLight[] = R"(#version 130
uniform mat4 osg_ViewMatrixInverse;
uniform vec3 sun_direction, sun_color, sky_color, bounce_color, haze_color;
uniform vec2 haze_range;
uniform sampler2DShadow shadow_map;
uniform mat4 shadow_matrix;
uniform float shadow_texel;
uniform int occluder_count;
uniform vec4 occluders[16];
in vec3 world, facing;

// Spread over a disk; the first four stand around its rim.
const vec2 kDisk[12] = vec2[](vec2(-0.840, -0.074), vec2(0.962, -0.195), vec2(0.185, -0.893), vec2(0.219, 0.867),
  vec2(-0.326, -0.406), vec2(-0.696, 0.457), vec2(-0.203, 0.421), vec2(0.473, -0.480), vec2(0.507, 0.064),
  vec2(0.796, 0.512), vec2(-0.322, -0.833), vec2(0.100, -0.100));

// Share of the sun that reaches p: soft at edges, and 1 beyond the shadow map, into which it fades.
float sunlight(vec3 p, vec3 n) {
  vec3 s = (shadow_matrix * vec4(p + n * (2.0 * shadow_texel), 1.0)).xyz;
  float border = max(abs(s.x - 0.5), abs(s.y - 0.5)) * 2.0;
  if (border >= 1.0 || s.z >= 1.0) return 1.0;
  vec2 blur = 2.5 / vec2(textureSize(shadow_map, 0));
  float lit = 0.0;
  int taken = 0;
  for (int i = 0; i < 12; ++i) {
    lit += textureLod(shadow_map, vec3(s.xy + kDisk[i] * blur, s.z), 0.0);
    ++taken;
    // Most places lie well inside or outside of a shadow, where the rim already agrees.
    if (i == 3 && (lit == 0.0 || lit == 4.0)) break;
  }
  return mix(lit / float(taken), 1.0, smoothstep(0.85, 1.0, border));
}

// Share of the sky that spheres nearby leave open above p.
float openness(vec3 p, vec3 n) {
  float open = 1.0;
  for (int i = 0; i < occluder_count; ++i) {
    vec3 d = occluders[i].xyz - p;
    float l = max(length(d), 1e-6), h = max(l / occluders[i].w, 1.0);
    open *= 1.0 - clamp(dot(n, d) / l, 0.0, 1.0) / (h * h);
  }
  return open;
}

// Film-like curve, so that neither white balls nor shaded walls lose their shape [Narkowicz 2015].
vec3 develop(vec3 c) {
  c *= 0.57;
  return pow(clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0), vec3(1.0 / 2.2));
}

vec3 shade(vec3 albedo, vec3 n, float open, float gloss) {
  vec3 eye = osg_ViewMatrixInverse[3].xyz;
  vec3 to_eye = normalize(eye - world);
  float sun = sunlight(world, normalize(facing)) * smoothstep(-0.02, 0.12, dot(n, sun_direction));
  vec3 light = sun_color * max(dot(n, sun_direction), 0.0) * sun;
  light += mix(bounce_color, sky_color, 0.5 + 0.5 * n.z) * open;
  vec3 color = albedo * light;
  color += sun_color * gloss * sun * pow(max(dot(n, normalize(to_eye + sun_direction)), 0.0), 60.0);
  float far = max(distance(eye, world) - haze_range.x, 0.0) / haze_range.y;
  return develop(mix(haze_color, color, exp(-far)));
}
)";

// Value noise with its slope, and octaves of it that fade out before they become finer than a pixel.
constexpr char kNoise[] = R"(
float hash(vec2 p) {
  vec3 q = fract(vec3(p.xyx) * 0.1031);
  q += dot(q, q.yzx + 33.33);
  return fract((q.x + q.y) * q.z);
}
vec3 noise(vec2 p) {
  vec2 i = floor(p), f = p - i, u = f * f * (3.0 - 2.0 * f), du = 6.0 * f * (1.0 - f);
  float a = hash(i), b = hash(i + vec2(1, 0)), c = hash(i + vec2(0, 1)), d = hash(i + vec2(1, 1));
  float k = a - b - c + d;
  return vec3(a + (b - a) * u.x + (c - a) * u.y + k * u.x * u.y - 0.5, du * (vec2(b - a, c - a) + k * u.yx));
}
// Height about -0.5 to 0.5 and slope for a longest wave of `wave` metres; the slope is over the phase, not over metres.
vec3 octaves(vec2 p, float wave, int count, float pixel) {
  vec3 sum = vec3(0.0);
  float weight = 0.5;
  vec2 q = p / wave;
  for (int i = 0; i < count; ++i) {
    float fade = 1.0 - smoothstep(0.3, 0.6, pixel / wave);
    if (fade <= 0.0) break;
    sum += noise(q) * weight * fade;
    q = mat2(1.6, 1.2, -1.2, 1.6) * q + 17.3;
    wave *= 0.5;
    weight *= 0.66;
  }
  return sum;
}
)";

constexpr char kGroundVertex[] = R"(#version 130
in vec2 sinkage;
out vec3 world, facing;
out float sunk, moved;
void main() {
  world = gl_Vertex.xyz;
  facing = gl_Normal;
  sunk = sinkage.x;
  moved = sinkage.y;
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)";

constexpr char kGroundFragment[] = R"(
uniform vec2 height_range;
uniform float detail_wave, sinkage_scale;
in float sunk, moved;

void main() {
  vec3 n = normalize(facing);
  float pixel = length(fwidth(world.xy)) * 0.7;
  vec3 broad = octaves(world.xy, detail_wave, 4, pixel);
  vec3 fine = octaves(world.xy + 311.7, detail_wave / 9.0, 7, pixel);
  float turned = smoothstep(0.02, 0.08, moved / sinkage_scale * (1.0 + 1.2 * fine.x + 0.8 * broad.x));

  // Grass gives way to dry ground in patches and higher up, both to bare earth and rock where it is steep.
  float height = clamp((world.z + sunk - height_range.x) * height_range.y, 0.0, 1.0);
  float dry = smoothstep(-0.28, 0.34, broad.x + 0.5 * fine.x + 0.55 * (height - 0.5) * step(1e-9, height_range.y));
  vec3 flat_color = mix(vec3(0.110, 0.140, 0.045), vec3(0.285, 0.230, 0.115), dry);
  flat_color *= 1.0 + 0.7 * fine.x;
  vec3 rock = mix(vec3(0.190, 0.155, 0.115), vec3(0.300, 0.260, 0.210), clamp(0.5 + fine.x, 0.0, 1.0));
  float steep = smoothstep(0.07, 0.20, 1.0 - n.z + 0.08 * fine.x);
  vec3 earth = mix(vec3(0.105, 0.060, 0.036), vec3(0.215, 0.130, 0.080), clamp(0.5 + 1.1 * fine.x, 0.0, 1.0));
  earth *= mix(1.0, 0.80, smoothstep(0.1, 1.2, sunk / sinkage_scale));
  vec3 albedo = mix(mix(flat_color, rock, steep), earth, turned);

  // Loose soil is rougher than what grew over it.
  n = normalize(n - vec3(fine.yz, 0.0) * mix(0.16, 0.30, turned));
  gl_FragColor = vec4(shade(albedo, n, openness(world, n), 0.0), 1.0);
}
)";

constexpr char kWallFragment[] = R"(
uniform float detail_wave;
in float sunk;

void main() {
  // Layers follow the depth below the ground, a little wavy; the first is topsoil.
  vec2 along = vec2(dot(world.xy, vec2(0.8, 0.6)), world.z * 3.0);
  float pixel = length(fwidth(world)) * 0.7;
  float wave = octaves(along, detail_wave, 4, pixel).x, grain = octaves(along * 3.0, detail_wave / 6.0, 4, pixel).x;
  float depth = sunk / detail_wave + 0.10 * wave;
  vec3 albedo = mix(vec3(0.130, 0.085, 0.055), vec3(0.330, 0.220, 0.140), smoothstep(0.02, 0.05, depth));
  albedo = mix(albedo, vec3(0.400, 0.310, 0.215), smoothstep(0.11, 0.13, depth));
  albedo = mix(albedo, vec3(0.300, 0.240, 0.185), smoothstep(0.19, 0.20, depth));
  albedo *= 1.0 + 0.7 * grain;
  gl_FragColor = vec4(shade(albedo, normalize(facing), 0.9, 0.0), 1.0);
}
)";

constexpr char kBallVertex[] = R"(#version 130
uniform mat4 osg_ViewMatrixInverse;
out vec3 world, facing, local;
void main() {
  local = gl_Vertex.xyz;
  world = (osg_ViewMatrixInverse * (gl_ModelViewMatrix * gl_Vertex)).xyz;
  facing = mat3(osg_ViewMatrixInverse) * (gl_NormalMatrix * gl_Normal);
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)";

constexpr char kBallFragment[] = R"(
uniform vec3 ball_color, pattern_color;
in vec3 local;

// 1 within `width` of a line at 0, smooth over a pixel.
float line(float x, float width) {
  float edge = fwidth(x) * 0.75;
  return 1.0 - smoothstep(width - edge, width + edge, abs(x));
}

void main() {
  // Eight meridians and the equator, as on a globe.
  vec3 p = normalize(local);
  float ring = length(p.xy);
  float meridian = ring * sin(4.0 * atan(p.y, p.x)) / 4.0;
  float mark = max(line(meridian, 0.014) * smoothstep(0.10, 0.14, ring), line(p.z, 0.045));
  vec3 n = normalize(facing);
  // Light that the ground throws back is weak below, where ball and ground meet.
  float open = 0.55 + 0.45 * smoothstep(-1.0, 0.2, n.z);
  gl_FragColor = vec4(shade(mix(ball_color, pattern_color, mark), n, open, 0.12), 1.0);
}
)";

constexpr char kDepthVertex[] = R"(#version 130
void main() { gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex; }
)";

constexpr char kDepthFragment[] = R"(#version 130
void main() { gl_FragColor = vec4(1.0); }
)";

constexpr char kBackgroundVertex[] = R"(#version 130
out float height;
void main() {
  height = 0.5 + 0.5 * gl_Vertex.y;
  gl_Position = vec4(gl_Vertex.xy, 1.0, 1.0);
}
)";

constexpr char kBackgroundFragment[] = R"(#version 130
uniform vec3 background_top, background_bottom;
in float height;
void main() {
  vec3 color = mix(background_bottom, background_top, smoothstep(0.0, 1.0, height));
  // Half a step of noise hides the bands of 8-bit colour.
  float dither = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
  gl_FragColor = vec4(color + dither / 255.0, 1.0);
}
)";

constexpr char kInkVertex[] = R"(#version 130
uniform vec3 ink, turned_ink, paper;
uniform float ink_cell, sinkage_scale;
in vec2 sinkage;
out vec3 color;
void main() {
  vec4 p = gl_ModelViewProjectionMatrix * gl_Vertex;
  // Lines closer than a few pixels would melt into a dark mass: they give way to paper.
  float cell = ink_cell > 0.0 ? ink_cell * gl_ProjectionMatrix[1][1] / max(p.w, 1e-6) : 1.0;
  vec3 line = mix(ink, turned_ink, smoothstep(0.02, 0.08, sinkage.y / sinkage_scale));
  color = mix(paper, line, 0.12 + 0.88 * smoothstep(0.002, 0.020, cell));
  gl_Position = p;
}
)";

constexpr char kInkFragment[] = R"(#version 130
in vec3 color;
void main() { gl_FragColor = vec4(color, 1.0); }
)";

static_assert(kMaxOccluders == 16, "the length of `occluders` in kLight");

osg::ref_ptr<osg::Program> make_program(const std::string& vertex, const std::string& fragment) {
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
  program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment));
  program->addBindAttribLocation("sinkage", kSinkageAttribute);
  return program;
}

}  // namespace

osg::ref_ptr<osg::Program> ground_program() {
  return make_program(kGroundVertex, std::string(kLight) + kNoise + kGroundFragment);
}
osg::ref_ptr<osg::Program> wall_program() {
  return make_program(kGroundVertex, std::string(kLight) + kNoise + kWallFragment);
}
osg::ref_ptr<osg::Program> ball_program() { return make_program(kBallVertex, std::string(kLight) + kBallFragment); }
osg::ref_ptr<osg::Program> depth_program() { return make_program(kDepthVertex, kDepthFragment); }
osg::ref_ptr<osg::Program> background_program() { return make_program(kBackgroundVertex, kBackgroundFragment); }
osg::ref_ptr<osg::Program> ink_program() { return make_program(kInkVertex, kInkFragment); }

}  // namespace divot::viewer
