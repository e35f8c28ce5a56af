#pragma once

// The ground and the walls of its block in GLSL.
namespace divot::viewer::glsl {

inline constexpr char kRamp[] = R"(
uniform vec3 ramp[5];
uniform vec2 ramp_range;
// Linear colour of a number on its scale, a little darkened, as light comes on top.
vec3 ramp_color(float value) {
  float t = clamp((value - ramp_range.x) * ramp_range.y, 0.0, 1.0) * 4.0;
  vec3 c = ramp[0];
  for (int i = 1; i < 5; ++i) c = mix(c, ramp[i], clamp(t - float(i - 1), 0.0, 1.0));
  return c * c * 0.75;
}
)";

inline constexpr char kShownNumber[] = R"(
#pragma import_defines(SOIL)
uniform int color_by;
#ifdef SOIL
uniform float material_number;
#endif
// The number that colours show, in the order of ColorBy.
float shown_number(vec3 p, vec3 n, float sunk, vec4 mark) {
  if (color_by == 1) return p.z;
  if (color_by == 2) return sunk;
  if (color_by == 3) return degrees(acos(clamp(n.z, 0.0, 1.0)));
  if (color_by == 4) return mark.x;
#ifdef SOIL
  return material_number;
#else
  return mark.y;
#endif
}
)";

// What a material of a colour or a picture of its own looks like, untouched. `lod`: below 0 the one that fits.
inline constexpr char kSoil[] = R"(
#if defined(SOIL_TEXTURE)
uniform sampler2D soil_texture;
uniform float soil_repeats, soil_texels;
vec3 soil_at(vec2 place, float lod) {
  vec3 c = lod < 0.0 ? texture(soil_texture, place * soil_repeats).rgb
                     : textureLod(soil_texture, place * soil_repeats, lod).rgb;
  return c * c * 0.75;
}
#elif defined(SOIL_COLOR)
uniform vec3 soil_color;
vec3 soil_at(vec2 place, float lod) { return soil_color; }
#endif
// Below the dry crust soil is moister, which makes it darker and its colour stronger.
vec3 turned_soil(vec3 soil) { return soil * mix(vec3(0.36), soil / max(max(soil.r, max(soil.g, soil.b)), 1e-3), 0.25); }
)";

inline constexpr char kNoise[] = R"(
// Value noise with its slope, and octaves of it that fade out before they become finer than a pixel.
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

inline constexpr char kGroundVertex[] = R"(in vec2 sinkage;
in vec4 mark;
out vec3 world, facing;
out float sunk, moved;
#ifdef NUMBERS
out float shown;
#endif
void main() {
  world = gl_Vertex.xyz;
  facing = gl_Normal;
  sunk = sinkage.x;
  moved = sinkage.y;
#ifdef NUMBERS
  shown = shown_number(world, normalize(gl_Normal), sunk, mark);
#endif
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)";

inline constexpr char kGroundFragment[] = R"(
uniform vec2 height_range;
uniform float detail_wave, sinkage_scale;
in float sunk, moved;
#ifdef NUMBERS
in float shown;
#endif

void main() {
  vec3 n = normalize(facing);
#ifdef NUMBERS
  gl_FragColor = vec4(shade(ramp_color(shown), n, openness(world, n), 0.0), 1.0);
#else
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
#if defined(SOIL_TEXTURE) || defined(SOIL_COLOR)
  vec3 soil = soil_at(world.xy, -1.0);
  vec3 earth = turned_soil(soil) * (1.0 + 0.7 * fine.x) * mix(1.0, 0.80, smoothstep(0.1, 1.2, sunk / sinkage_scale));
#ifdef SOIL_COLOR
  soil *= 1.0 + 0.35 * fine.x + 0.2 * broad.x;
#endif
  vec3 albedo = mix(soil, earth, turned);
#else
  vec3 earth = mix(vec3(0.105, 0.060, 0.036), vec3(0.215, 0.130, 0.080), clamp(0.5 + 1.1 * fine.x, 0.0, 1.0));
  earth *= mix(1.0, 0.80, smoothstep(0.1, 1.2, sunk / sinkage_scale));
  vec3 albedo = mix(mix(flat_color, rock, steep), earth, turned);
#endif

  // Loose soil is rougher than what grew over it.
  n = normalize(n - vec3(fine.yz, 0.0) * mix(0.16, 0.30, turned));
  gl_FragColor = vec4(shade(albedo, n, openness(world, n), 0.0), 1.0);
#endif
}
)";

inline constexpr char kWallFragment[] = R"(
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

}  // namespace divot::viewer::glsl
