#pragma once

// The ground for software renderers: light, haze and what the ground is like come from the vertices, noise from a
// texture. A pixel costs about a tenth of the fine one.
namespace divot::viewer::glsl {

// What a pixel or, where DENSE is defined, a vertex does. Without branches: software renderers take both sides of them.
inline constexpr char kFastGroundColor[] = R"(
uniform float sinkage_scale, detail_wave;
uniform vec3 haze_color;
uniform sampler2DShadow shadow_map;
uniform sampler2D grain;
uniform vec4 ball_shadows[6];  // place in the shadow map, and 1 / radius there

// At vertices a picture is taken as coarse as the mesh.
#ifdef SOIL_TEXTURE
#define SOIL_LOD log2(max(sinkage_scale * soil_texels, 1.0))
#else
#define SOIL_LOD 0.0
#endif

// `ground`: how turned, how dry by height, how steep, how sunk.
vec3 ground_color(vec3 sun_light, vec3 sky_light, vec3 shadow_place, vec3 grain_place_haze, vec4 ground, float shown) {
  float lit = textureLod(shadow_map, shadow_place, 0.0);
#ifdef BALLS
  for (int i = 0; i < BALLS; ++i) {
    vec2 d = (ball_shadows[i].xy - shadow_place.xy) * ball_shadows[i].w;
    lit *= clamp(max(dot(d, d) * 6.0 - 5.5, step(shadow_place.z, ball_shadows[i].z)), 0.0, 1.0);
  }
#endif
#ifdef NUMBERS
  vec3 albedo = ramp_color(shown);
#else
#ifdef DENSE
  vec2 noise = textureLod(grain, grain_place_haze.xy, 0.0).xw - 0.5;  // broad, fine
#else
  vec2 noise = texture(grain, grain_place_haze.xy).xw - 0.5;
#endif
  float turned = clamp(ground.x * (16.0 + 19.0 * noise.y + 13.0 * noise.x) - 0.33, 0.0, 1.0);
#if defined(SOIL_TEXTURE) || defined(SOIL_COLOR)
#ifdef DENSE
  vec3 soil = soil_at(grain_place_haze.xy * (4.0 * detail_wave), SOIL_LOD);
#else
  vec3 soil = soil_at(grain_place_haze.xy * (4.0 * detail_wave), -1.0);
#endif
  vec3 earth = turned_soil(soil) * (1.0 + 0.7 * noise.y) * ground.w;
#ifdef SOIL_COLOR
  soil *= 1.0 + 0.35 * noise.y + 0.2 * noise.x;
#endif
  vec3 albedo = mix(soil, earth, turned);
#else
  float dry = clamp((noise.x + 0.5 * noise.y + ground.y) * 1.9 + 0.46, 0.0, 1.0);
  float steep = clamp((ground.z + 0.08 * noise.y) * 9.0 - 0.72, 0.0, 1.0);
  vec3 albedo = mix(vec3(0.110, 0.140, 0.045), vec3(0.285, 0.230, 0.115), dry) * (1.0 + 0.7 * noise.y);
  albedo = mix(albedo, vec3(0.245, 0.207, 0.162) + vec3(0.110, 0.105, 0.095) * noise.y, steep);
  albedo = mix(albedo, (vec3(0.160, 0.095, 0.058) + vec3(0.120, 0.077, 0.048) * noise.y) * ground.w, turned);
#endif
  // Uneven ground catches the low sun unevenly.
  lit *= 1.0 + (0.5 + 0.5 * turned) * noise.y;
#endif
  return develop(mix(haze_color, albedo * (sun_light * lit + sky_light), grain_place_haze.z));
}
)";

inline constexpr char kFastGroundVertex[] = R"(
uniform vec3 sun_direction, sun_color, sky_color, bounce_color;
uniform mat4 osg_ViewMatrixInverse, shadow_matrix;
uniform vec2 haze_range, height_range;
uniform float shadow_texel;
in vec2 sinkage;
in vec4 mark;
#ifdef DENSE
out vec3 color;
vec3 sun_light, sky_light, shadow_place, grain_place_haze;
vec4 ground;
#else
out vec3 sun_light, sky_light, shadow_place, grain_place_haze;
out vec4 ground;
#ifdef NUMBERS
out float shown;
#endif
#endif

void main() {
  vec3 n = normalize(gl_Normal), world = gl_Vertex.xyz;
  float toward = dot(n, sun_direction);
  sun_light = sun_color * max(toward, 0.0) * smoothstep(-0.02, 0.12, toward);
  sky_light = mix(bounce_color, sky_color, 0.5 + 0.5 * n.z) * openness(world, n);
  shadow_place = (shadow_matrix * vec4(world + n * (2.0 * shadow_texel), 1.0)).xyz;
  float height = clamp((world.z + sinkage.x - height_range.x) * height_range.y, 0.0, 1.0);
  ground = vec4(sinkage.y / sinkage_scale, 0.55 * (height - 0.5) * step(1e-9, height_range.y), 1.0 - n.z,
                1.0 - 0.2 * smoothstep(0.1, 1.2, sinkage.x / sinkage_scale));
  grain_place_haze = vec3(world.xy * (0.25 / detail_wave),
                          exp(-max(distance(osg_ViewMatrixInverse[3].xyz, world) - haze_range.x, 0.0) / haze_range.y));
#ifdef NUMBERS
#ifdef DENSE
  float shown;
#endif
  shown = shown_number(world, n, sinkage.x, mark);
#else
  const float shown = 0.0;
#endif
#ifdef DENSE
  color = ground_color(sun_light, sky_light, shadow_place, grain_place_haze, ground, shown);
#endif
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)";

inline constexpr char kFastGroundFragment[] = R"(
#ifdef DENSE
in vec3 color;
void main() { gl_FragColor = vec4(color, 1.0); }
#else
in vec3 sun_light, sky_light, shadow_place, grain_place_haze;
in vec4 ground;
#ifdef NUMBERS
in float shown;
#else
const float shown = 0.0;
#endif
void main() {
  gl_FragColor = vec4(ground_color(sun_light, sky_light, shadow_place, grain_place_haze, ground, shown), 1.0);
}
#endif
)";

inline constexpr char kFastWallFragment[] = R"(
uniform sampler2D grain;
uniform float detail_wave;
in float sunk;

void main() {
  vec2 along = vec2(dot(world.xy, vec2(0.8, 0.6)), world.z * 3.0) / detail_wave;
  float wave = texture(grain, along * 0.25).x - 0.5, fine = texture(grain, along * 0.5).w - 0.5;
  float depth = sunk / detail_wave + 0.10 * wave;
  vec3 albedo = mix(vec3(0.130, 0.085, 0.055), vec3(0.330, 0.220, 0.140), smoothstep(0.02, 0.05, depth));
  albedo = mix(albedo, vec3(0.400, 0.310, 0.215), smoothstep(0.11, 0.13, depth));
  albedo = mix(albedo, vec3(0.300, 0.240, 0.185), smoothstep(0.19, 0.20, depth));
  gl_FragColor = vec4(shade(albedo * (1.0 + 0.7 * fine), normalize(facing), 0.9, 0.0), 1.0);
}
)";

}  // namespace divot::viewer::glsl
