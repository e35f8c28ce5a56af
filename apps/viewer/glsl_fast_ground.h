#pragma once

// The ground for software renderers: light, haze and what the ground is like come from the vertices, noise from a
// texture. A pixel costs about a tenth of the fine one.
namespace divot::viewer::glsl {

inline constexpr char kFastGroundVertex[] = R"(
uniform vec3 sun_direction, sun_color, sky_color, bounce_color;
uniform mat4 osg_ViewMatrixInverse, shadow_matrix;
uniform vec2 haze_range, height_range;
uniform float shadow_texel, sinkage_scale;
in vec2 sinkage;
in vec4 mark;
out vec3 world, sun_light, sky_light, shadow_place;
out vec4 ground;  // how turned, how high, how steep, how sunk
out float haze, shown;
void main() {
  vec3 n = normalize(gl_Normal);
  world = gl_Vertex.xyz;
  float toward = dot(n, sun_direction);
  sun_light = sun_color * max(toward, 0.0) * smoothstep(-0.02, 0.12, toward);
  sky_light = mix(bounce_color, sky_color, 0.5 + 0.5 * n.z);
  shadow_place = (shadow_matrix * vec4(world + n * (2.0 * shadow_texel), 1.0)).xyz;
  float height = clamp((world.z + sinkage.x - height_range.x) * height_range.y, 0.0, 1.0);
  ground = vec4(sinkage.y / sinkage_scale, 0.55 * (height - 0.5) * step(1e-9, height_range.y), 1.0 - n.z,
                smoothstep(0.1, 1.2, sinkage.x / sinkage_scale));
  haze = exp(-max(distance(osg_ViewMatrixInverse[3].xyz, world) - haze_range.x, 0.0) / haze_range.y);
  shown = shown_number(world, n, sinkage.x, mark);
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)";

inline constexpr char kFastGroundFragment[] = R"(
uniform vec3 sun_direction, haze_color;
uniform sampler2DShadow shadow_map;
uniform sampler2D grain;
uniform int color_by, occluder_count;
uniform vec4 occluders[16];
uniform float detail_wave;
in vec3 world, sun_light, sky_light, shadow_place;
in vec4 ground;
in float haze, shown;

void main() {
  float lit = 1.0, open = 1.0;
  if (max(abs(shadow_place.x - 0.5), abs(shadow_place.y - 0.5)) < 0.5 && shadow_place.z < 1.0) {
    lit = textureLod(shadow_map, shadow_place, 0.0);
  }
  for (int i = 0; i < occluder_count; ++i) {
    vec3 d = occluders[i].xyz - world;
    float along = dot(d, sun_direction), l2 = dot(d, d), r2 = occluders[i].w * occluders[i].w;
    if (along > 0.0) lit *= smoothstep(0.9 * r2, 1.1 * r2, l2 - along * along);
    open *= 1.0 - max(d.z, 0.0) * inversesqrt(l2) * min(r2 / l2, 1.0);
  }

  vec3 albedo;
  if (color_by != 0) {
    albedo = ramp_color(shown);
  } else {
    float broad = texture(grain, world.xy * (0.11 / detail_wave)).x - 0.5;
    float fine = texture(grain, world.xy * (1.3 / detail_wave) + 0.37).x - 0.5;
    float turned = smoothstep(0.02, 0.08, ground.x * (1.0 + 1.2 * fine + 0.8 * broad));
    float dry = smoothstep(-0.28, 0.34, broad + 0.5 * fine + ground.y);
    albedo = mix(vec3(0.110, 0.140, 0.045), vec3(0.285, 0.230, 0.115), dry) * (1.0 + 0.7 * fine);
    albedo = mix(albedo, mix(vec3(0.190, 0.155, 0.115), vec3(0.300, 0.260, 0.210), 0.5 + fine),
                 smoothstep(0.07, 0.20, ground.z + 0.08 * fine));
    vec3 earth = mix(vec3(0.105, 0.060, 0.036), vec3(0.215, 0.130, 0.080), 0.5 + 1.1 * fine);
    albedo = mix(albedo, earth * (1.0 - 0.2 * ground.w), turned);
    // Uneven ground catches the low sun unevenly.
    lit *= 1.0 + (0.5 + 0.5 * turned) * fine;
  }
  gl_FragColor = vec4(develop(mix(haze_color, albedo * (sun_light * lit + sky_light * open), haze)), 1.0);
}
)";

inline constexpr char kFastWallFragment[] = R"(
uniform sampler2D grain;
uniform float detail_wave;
in float sunk;

void main() {
  vec2 along = vec2(dot(world.xy, vec2(0.8, 0.6)), world.z * 3.0) / detail_wave;
  float wave = texture(grain, along * 0.11).x - 0.5, fine = texture(grain, along * 2.0).x - 0.5;
  float depth = sunk / detail_wave + 0.10 * wave;
  vec3 albedo = mix(vec3(0.130, 0.085, 0.055), vec3(0.330, 0.220, 0.140), smoothstep(0.02, 0.05, depth));
  albedo = mix(albedo, vec3(0.400, 0.310, 0.215), smoothstep(0.11, 0.13, depth));
  albedo = mix(albedo, vec3(0.300, 0.240, 0.185), smoothstep(0.19, 0.20, depth));
  gl_FragColor = vec4(shade(albedo * (1.0 + 0.7 * fine), normalize(facing), 0.9, 0.0), 1.0);
}
)";

}  // namespace divot::viewer::glsl
