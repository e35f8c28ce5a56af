#pragma once

// Balls, lines, points, dust and what is behind everything, in GLSL.
namespace divot::viewer::glsl {

inline constexpr char kBallVertex[] = R"(#version 130
uniform mat4 osg_ViewMatrixInverse;
out vec3 world, facing, local;
void main() {
  local = gl_Vertex.xyz;
  world = (osg_ViewMatrixInverse * (gl_ModelViewMatrix * gl_Vertex)).xyz;
  facing = mat3(osg_ViewMatrixInverse) * (gl_NormalMatrix * gl_Normal);
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)";

inline constexpr char kBallPattern[] = R"(
uniform vec3 ball_color, pattern_color;
uniform float pattern_share;
in vec3 local;

// 1 within `width` of a line at 0, smooth over a pixel.
float line(float x, float width) {
  float edge = fwidth(x) * 0.75;
  return 1.0 - smoothstep(width - edge, width + edge, abs(x));
}

// Colour of the ball at a place on it.
vec3 patterned() {
  // Eight meridians and the equator, as on a globe.
  vec3 p = normalize(local);
  float ring = length(p.xy);
  // ring sin(4 angle) / 4, without the angle.
  float meridian = p.x * p.y * (p.x * p.x - p.y * p.y) / max(ring * ring * ring, 1e-9);
  float mark = max(line(meridian, 0.014) * smoothstep(0.10, 0.14, ring), line(p.z, 0.045));
  return mix(ball_color, pattern_color, mark * pattern_share);
}
)";

inline constexpr char kBallFragment[] = R"(
void main() {
  vec3 n = normalize(facing);
  // Light that the ground throws back is weak below, where ball and ground meet.
  float open = 0.55 + 0.45 * smoothstep(-1.0, 0.2, n.z);
  gl_FragColor = vec4(shade(patterned(), n, open, 0.12), 1.0);
}
)";

// The same with light from the vertices, which are dense on balls that are large in the picture.
inline constexpr char kFastBallVertex[] = R"(
out vec3 local, light, glance;
out float haze;
void main() {
  local = gl_Vertex.xyz;
  vec3 world = (osg_ViewMatrixInverse * (gl_ModelViewMatrix * gl_Vertex)).xyz;
  vec3 n = normalize(mat3(osg_ViewMatrixInverse) * (gl_NormalMatrix * gl_Normal));
  vec3 eye = osg_ViewMatrixInverse[3].xyz;
  float toward = dot(n, sun_direction);
  vec3 sun = sun_color * (sunlight(world, n) * smoothstep(-0.02, 0.12, toward));
  float open = 0.55 + 0.45 * smoothstep(-1.0, 0.2, n.z);
  light = sun * max(toward, 0.0) + mix(bounce_color, sky_color, 0.5 + 0.5 * n.z) * open;
  float shine = max(dot(n, normalize(normalize(eye - world) + sun_direction)), 0.0);
  for (int i = 0; i < 6; ++i) shine *= shine;
  glance = sun * (0.12 * shine);
  haze = exp(-max(distance(eye, world) - haze_range.x, 0.0) / haze_range.y);
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)";

inline constexpr char kFastBallFragment[] = R"(
uniform vec3 haze_color;
in vec3 light, glance;
in float haze;
void main() { gl_FragColor = vec4(develop(mix(haze_color, patterned() * light + glance, haze)), 1.0); }
)";

inline constexpr char kDepthVertex[] = R"(#version 130
void main() { gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex; }
)";

inline constexpr char kDepthFragment[] = R"(#version 130
void main() { gl_FragColor = vec4(1.0); }
)";

inline constexpr char kBackgroundVertex[] = R"(#version 130
uniform vec3 background_top, background_bottom;
noperspective out vec3 color;
void main() {
  color = mix(background_bottom, background_top, smoothstep(0.0, 1.0, 0.5 + 0.5 * gl_Vertex.y));
  gl_Position = vec4(gl_Vertex.xy, 1.0, 1.0);
}
)";

inline constexpr char kBackgroundFragment[] = R"(
noperspective in vec3 color;
void main() {
#ifdef DITHER
  // Half a step of noise hides the bands of 8-bit colour.
  float dither = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
  gl_FragColor = vec4(color + dither / 255.0, 1.0);
#else
  gl_FragColor = vec4(color, 1.0);
#endif
}
)";

inline constexpr char kInkVertex[] = R"(
uniform vec3 ink, turned_ink, paper;
uniform float ink_cell, sinkage_scale;
in vec2 sinkage;
in vec4 mark;
out vec3 color;
void main() {
  vec4 p = gl_ModelViewProjectionMatrix * gl_Vertex;
  // Lines closer than a few pixels would melt into a dark mass: they give way to paper.
  float cell = ink_cell > 0.0 ? ink_cell * gl_ProjectionMatrix[1][1] / max(p.w, 1e-6) : 1.0;
  vec3 line = mix(ink, turned_ink, smoothstep(0.02, 0.08, sinkage.y / sinkage_scale));
  if (color_by != 0) line = sqrt(ramp_color(shown_number(gl_Vertex.xyz, normalize(gl_Normal), sinkage.x, mark)));
  color = mix(paper, line, 0.12 + 0.88 * smoothstep(0.002, 0.020, cell));
  gl_Position = p;
}
)";

inline constexpr char kInkFragment[] = R"(#version 130
in vec3 color;
void main() { gl_FragColor = vec4(color, 1.0); }
)";

// Points as large as `point_size` metres but never too small to be seen, drawn a little nearer than the ground they are
// on.
inline constexpr char kPointVertex[] = R"(#version 130
uniform float point_size;
flat out vec4 tint;
void main() {
  tint = gl_Color;
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
  gl_PointSize = clamp(point_size * gl_ProjectionMatrix[1][1] / max(gl_Position.w, 1e-6), 2.0, 7.0);
  gl_Position.z -= 1e-4 * gl_Position.w;
}
)";

inline constexpr char kTintFragment[] = R"(#version 130
flat in vec4 tint;
void main() { gl_FragColor = tint; }
)";

// Soft round dabs that face the eye. The texture coordinate holds the corner, -1 or 1, and the radius in metres.
// Colours are multiplied by their opacity beforehand, so that flashes can add light.
inline constexpr char kPuffVertex[] = R"(#version 130
noperspective out vec2 corner;
flat out vec4 tint;
void main() {
  corner = gl_MultiTexCoord0.xy;
  tint = gl_Color;
  vec4 place = gl_ModelViewMatrix * gl_Vertex;
  place.xy += corner * gl_MultiTexCoord0.z;
  gl_Position = gl_ProjectionMatrix * place;
}
)";

inline constexpr char kPuffFragment[] = R"(#version 130
noperspective in vec2 corner;
flat in vec4 tint;
void main() {
  float soft = max(1.0 - dot(corner, corner), 0.0);
  gl_FragColor = tint * soft * soft;
}
)";

// A picture over all of the viewport.
inline constexpr char kStretchVertex[] = R"(#version 130
noperspective out vec2 place;
void main() {
  place = 0.5 + 0.5 * gl_Vertex.xy;
  gl_Position = vec4(gl_Vertex.xy, 0.0, 1.0);
}
)";

inline constexpr char kStretchFragment[] = R"(#version 130
uniform sampler2D picture;
noperspective in vec2 place;
void main() { gl_FragColor = texture(picture, place); }
)";

}  // namespace divot::viewer::glsl
