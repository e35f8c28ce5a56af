#include "laws/crater.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "laws/blast.h"

namespace divot::laws {
namespace {

// Radius of the ground that a fully buried charge breaks, over (kg TNT)^(1/3), where a charge at the surface makes a
// crater of kBrokenAt: venting costs that one 97 % of its energy. Deeper than this nothing shows (a camouflet). What a
// deep charge has to do is lift, which is much the same in every ground; what one at the surface has to do is break,
// which is not: the broken radius goes with the root of the surface crater's. Fitted to Stagecoach and Scooter in
// alluvium, Buckboard and Pre-Schooner in basalt and ConWep's soil together.
constexpr double kBrokenSphere = 1.36, kBrokenAt = 0.4;
// How coupling grows with depth: the vent closes with about the square of what is left of the cover.
constexpr double kVent = 2.2;
// Blast strength per pressure of soil lifted: the strength is in units of eq. 13's pressure, not of what soil carries.
// Fitted to Scooter against Stagecoach: 500 and 20 tons at nearly one scaled depth.
constexpr double kOverburden = 8e-4;
// What a surface crater lifts lies a sixth of its radius deep (the centroid of a paraboloid half as deep as wide); a
// buried charge lifts its cover as well.
constexpr double kLifted = 1.0 / 6;
// What a buried charge throws leaves the ground at kThrow (W^(1/3) / depth)^2, m/s for kg and m, and falls back where
// that does not carry it past its cover: v^2 / (g depth). So a large charge's crater is filled at a scaled depth from
// which a small one's is still thrown clear. Fitted to Stagecoach I and ConWep, 18 t and 221 kg at 0.9 m/kg^(1/3).
constexpr double kThrow = 9.25, kFallsBack = 1.5;
// A burst in the air: radius and depth end at these heights in crater radii, 0.6 and 0.5 m/kg^(1/3) in generic soil,
// with these exponents. An engineering guess: there is next to no data.
constexpr double kRadiusEnds = 1.5, kRadiusExponent = 0.8, kDepthEnds = 1.25, kDepthExponent = 1.5;
// Lips of bursts just above ground hold 20 to 30 % of the crater's volume, at it 15 to 20 %, of deep ones 50 to 70 %
// [EPG].
constexpr double kScoured = 0.35, kScourHeight = 0.1, kDeepLip = 0.6, kShallow = 0.15, kDeep = 0.8;
// Volume of the crater's profile over pi R^2 depth.
constexpr double kBowl = 0.45;
// Soil is compacted out to so many crater radii from the charge, the end of the plastic zone [Glasstone & Dolan 1977].
constexpr double kCompacted = 2.5;
// Lip: rounded, so that it is as high on a coarse mesh as on a fine one, and about as steep as loose soil stands. Thin
// ejecta fall as r^-3.86 [DNA 1984] and end at 2.15 radii [TM 5-855-1].
constexpr double kCrest = 1.12, kFoot = 1.3, kThinHeight = 0.01, kThin = 1.8, kThinExponent = 3.86;
constexpr double kUpthrustExponent = 2;

double smooth(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Radius of the surface crater in soil whose weight holds it together too: R^3 (Y + weight) is the charge's.
double weighed_radius(double yield, const Medium& soil, double buried, double gravity) {
  const double light = surface_radius(yield, soil.blast_strength);
  const double per_metre = kOverburden * soil.density * gravity / soil.blast_strength;
  // x^3 (1 + w (x/6 + D)) grows with x and is convex: Newton's method from `light` does not overshoot.
  double x = light;
  for (int pass = 0; pass < 8; ++pass) {
    const double heavier = 1 + per_metre * (kLifted * x + buried);
    const double value = x * x * x * heavier - light * light * light;
    const double slope = 3 * x * x * heavier + x * x * x * per_metre * kLifted;
    x -= value / slope;
  }
  return x;
}

}  // namespace

CraterSize scaled_crater(double yield, double height, const Medium& soil, double gravity) {
  const double buried = std::max(0.0, -height);
  const double surface = weighed_radius(yield, soil, buried, gravity);
  const double shape = surface_depth(yield, soil.blast_strength, soil.blast_drag) /
                       surface_radius(yield, soil.blast_strength);  // depth over radius of a surface crater
  if (height > 0) {
    // A charge that touches the ground has its centre a charge's radius up: only what is well above that is height.
    const double h = height * height / (height + charge_radius(yield)) / surface;
    if (h >= kDepthEnds) return {};
    const double lip = soil.ejecta_share * (1 + kScoured * smooth(h / kScourHeight));
    return {surface * std::pow(1 - h / kRadiusEnds, kRadiusExponent),
            surface * shape * std::pow(1 - h / kDepthEnds, kDepthExponent), std::min(lip, 1.0)};
  }
  const double size = std::cbrt(1000 * yield), light = surface_radius(yield, soil.blast_strength);
  const double whole = kBrokenSphere * std::sqrt(size * light / kBrokenAt) * (surface / light), s = buried / whole;
  if (s >= 1) return {};
  const double broken = whole - (whole - surface) * std::pow(1 - s, kVent);
  const double radius = std::sqrt(broken * broken - buried * buried);
  const double scaled = buried / size, slow = gravity * buried * std::pow(scaled, 4) / (kThrow * kThrow);
  const double depth = shape * radius / (1 + std::pow(slow, kFallsBack));
  const double deep = smooth((s - kShallow) / (kDeep - kShallow));
  const double lip = soil.ejecta_share + std::max(0.0, kDeepLip - soil.ejecta_share) * deep;
  return {radius, depth, lip};
}

double crater_profile(double radius, double above, double crater_radius) {
  const double source = kSourceHeight * crater_radius, up = source - above;
  if (up <= 0) return 0;
  // Pressure over that at the edge, less the 1 at which soil begins to fail.
  const auto excess = [&](double r, double h) {
    const double slant = r * r + h * h, edge = crater_radius * crater_radius + source * source;
    return h / source * (edge / slant) * (edge / slant) - 1;
  };
  return std::clamp(excess(radius, up) / excess(0, source), 0.0, 1.0);
}

double leaving_share(const CraterSize& crater, double buried, double compaction_limit) {
  // A half ball below the ground, or below the charge with a cylinder above it.
  const double zone = kCompacted * crater.radius, round = std::numbers::pi * zone * zone;
  const double capacity = compaction_limit * round * (2.0 / 3 * zone + buried);
  const double volume = kBowl * std::numbers::pi * crater.radius * crater.radius * crater.depth;
  return std::clamp(1 - capacity / volume, crater.lip_share, 1.0);
}

double overlap(double radius_a, double radius_b, double distance) {
  const double small = std::min(radius_a, radius_b), both = radius_a + radius_b, apart = radius_a - radius_b;
  if (small <= 0 || distance >= both) return 0;
  if (distance <= std::abs(apart)) return 1;
  const double lens = (both - distance) * (both - distance) *
                      (distance * distance + 2 * distance * both - 3 * apart * apart) / (12 * distance);
  return std::min(1.0, lens / (4.0 / 3 * small * small * small));
}

double ejecta_profile(double ratio) {
  if (ratio <= 1 || ratio >= kEjectaEnd) return 0;
  if (ratio < kCrest) return smooth((ratio - 1) / (kCrest - 1));
  const double thin = kThinHeight * std::pow(std::max(ratio, kThin) / kThin, -kThinExponent);
  return thin + (1 - thin) * smooth((kFoot - ratio) / (kFoot - kCrest));
}

double upthrust_profile(double ratio) {
  if (ratio <= 1 || ratio >= kUpthrustEnd) return 0;
  if (ratio < kCrest) return smooth((ratio - 1) / (kCrest - 1));
  const double far = (ratio - kCrest) / (kUpthrustEnd - kCrest);
  return std::pow(ratio / kCrest, -kUpthrustExponent) * (1 - far);
}

}  // namespace divot::laws
