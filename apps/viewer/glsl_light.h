#pragma once

// Sun, sky light, haze and shadows in GLSL: shared by everything that is lit.
namespace divot::viewer::glsl {

// Varyings are taken inside the triangle (centroid): extrapolated to a pixel's middle outside of it they would sprinkle
// dark dots along ridges.
inline constexpr char kLightUniforms[] = R"(uniform mat4 osg_ViewMatrixInverse;
uniform vec3 sun_direction, sun_color, sky_color, bounce_color, haze_color;
uniform vec2 haze_range;
uniform sampler2DShadow shadow_map;
uniform mat4 shadow_matrix;
uniform float shadow_texel;
)";

inline constexpr char kLitPlace[] = "in vec3 world, facing;\n";

inline constexpr char kFineSunlight[] = R"(// Spread over a disk; the first four stand around its rim.
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

)";

// One tap for the ground's shadow; balls throw theirs by formula, so that they stay round and need no map.
inline constexpr char kFastSunlight[] = R"(
#pragma import_defines(BALLS)
uniform vec4 ball_shadows[6];  // place in the shadow map, and 1 / radius there
float sunlight(vec3 p, vec3 n) {
  vec3 s = (shadow_matrix * vec4(p + n * (2.0 * shadow_texel), 1.0)).xyz;
  float lit = textureLod(shadow_map, s, 0.0);
#ifdef BALLS
  for (int i = 0; i < BALLS; ++i) {
    vec2 d = (ball_shadows[i].xy - s.xy) * ball_shadows[i].w;
    // A ball does not shade itself: the half turned to the sun lies before its middle, and normals darken the other.
    lit *= clamp(max(dot(d, d) * 6.0 - 5.5, step(s.z, ball_shadows[i].z)), 0.0, 1.0);
  }
#endif
  return lit;
}
)";

inline constexpr char kOpenness[] = R"(
uniform int occluder_count;
uniform vec4 occluders[16];
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

)";

inline constexpr char kDevelop[] =
    R"(// Film-like curve, so that neither white balls nor shaded walls lose their shape [Narkowicz 2015].
vec3 develop(vec3 c) {
  c *= 0.57;
  return pow(clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0), vec3(1.0 / 2.2));
}

)";

// A square root is close enough to the gamma of screens and much cheaper.
inline constexpr char kFastDevelop[] = R"(
vec3 develop(vec3 c) {
  c *= 0.57;
  return sqrt(clamp(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14), 0.0, 1.0)) * 0.965;
}
)";

inline constexpr char kShade[] = R"(// x to the 64th.
float shine(float x) {
  for (int i = 0; i < 6; ++i) x *= x;
  return x;
}

vec3 shade(vec3 albedo, vec3 n, float open, float gloss) {
  vec3 eye = osg_ViewMatrixInverse[3].xyz;
  vec3 to_eye = normalize(eye - world);
  float sun = sunlight(world, normalize(facing)) * smoothstep(-0.02, 0.12, dot(n, sun_direction));
  vec3 light = sun_color * max(dot(n, sun_direction), 0.0) * sun;
  light += mix(bounce_color, sky_color, 0.5 + 0.5 * n.z) * open;
  vec3 color = albedo * light;
  color += sun_color * gloss * sun * shine(max(dot(n, normalize(to_eye + sun_direction)), 0.0));
  float far = max(distance(eye, world) - haze_range.x, 0.0) / haze_range.y;
  return develop(mix(haze_color, color, exp(-far)));
}
)";

}  // namespace divot::viewer::glsl
