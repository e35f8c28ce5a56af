// The crater of the scaled model as pure numbers: against what was measured, and against how it must behave.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "laws/blast.h"
#include "laws/crater.h"

namespace divot::laws {
namespace {

constexpr double kGravity = 9.81;

// Soil whose light surface craters measure `radius` and `depth` over the cube root of the charge, m/kg^(1/3).
Medium soil(double radius, double depth, double density = 1600) {
  Material m;
  const double ratio = 0.3566 / radius, strength = ratio * ratio * ratio;
  m.blast_strength *= strength;
  m.blast_drag *= strength * 0.143 / depth;
  m.density = density;
  return make_medium(m);
}

TEST(LawsCrater, SmallChargesFollowTheCubeRootAndLargeOnesFallBelowIt) {
  const Medium sand = soil(0.297, 0.149);
  const auto scaled = [&](double kg, double gravity) {
    return scaled_crater(kg / 1000, 0, sand, gravity).radius / std::cbrt(kg);
  };
  EXPECT_NEAR(scaled(1000, kGravity), scaled(1, kGravity), 0.01 * scaled(1, kGravity));
  double before = scaled(1, kGravity);
  for (double kg = 10; kg <= 1e13; kg *= 10) {
    EXPECT_LT(scaled(kg, kGravity), before) << kg;
    EXPECT_NEAR(scaled(kg, 0), scaled(1, 0), 1e-9) << "weightless soil knows only the cube root";
    before = scaled(kg, kGravity);
  }
  // In the limit weight is all: the fourth root.
  const double slope = std::log(scaled(1e18, kGravity) / scaled(1e17, kGravity)) / std::log(10.0) + 1.0 / 3;
  EXPECT_NEAR(slope, 0.25, 0.003);
}

// The radius solves its own balance: x^3 (1 + weight (x/6 + D) / strength) is the light crater's.
TEST(LawsCrater, WeightAddsToStrength) {
  const Medium clay = soil(0.456, 0.228, 1900);
  for (const double yield : {0.001, 1.0, 500.0, 5000.0}) {
    const double radius = scaled_crater(yield, 0, clay, kGravity).radius;
    const double weighed = clay.blast_strength + 8e-4 * clay.density * kGravity * radius / 6;
    EXPECT_NEAR(radius, surface_radius(yield, weighed), 1e-6 * radius);
  }
}

TEST(LawsCrater, BurialMakesItLargerUpToAnOptimumThenNothing) {
  const Medium loam = soil(0.4, 0.2);
  std::vector<double> volume, lip;
  for (int k = 0; k <= 150; ++k) {
    const CraterSize size = scaled_crater(0.001, -0.01 * k, loam, kGravity);  // 1 kg: metres are m/kg^(1/3)
    volume.push_back(size.radius * size.radius * size.depth);
    if (size.radius > 0) lip.push_back(size.lip_share);
  }
  const auto best = std::max_element(volume.begin(), volume.end());
  const auto optimum = static_cast<double>(best - volume.begin()) / 100;
  EXPECT_GE(optimum, 0.4);
  EXPECT_LE(optimum, 0.75);
  EXPECT_TRUE(std::is_sorted(volume.begin(), best)) << "grows to the optimum";
  EXPECT_TRUE(std::is_sorted(best, volume.end(), std::greater<>())) << "and falls beyond it";
  EXPECT_EQ(volume.back(), 0) << "a camouflet";
  for (std::size_t k = 1; k < volume.size(); ++k)
    EXPECT_LT(std::abs(volume[k] - volume[k - 1]), 0.05 * *best) << "no jump at " << k << " cm";
  EXPECT_TRUE(std::is_sorted(lip.begin(), lip.end()));
  EXPECT_NEAR(lip.front(), 0.185, 1e-6);
  EXPECT_GE(lip.back(), 0.5);
}

TEST(LawsCrater, HeightMakesItWideAndShallowThenNothing) {
  const Medium loam = soil(0.4, 0.2);
  CraterSize before = scaled_crater(0.001, 0, loam, kGravity);
  for (double height = 0.02; height < 0.54; height += 0.02) {
    const CraterSize size = scaled_crater(0.001, height, loam, kGravity);
    EXPECT_LT(size.radius, before.radius) << height;
    EXPECT_LT(size.depth / size.radius, before.depth / before.radius) << height;
    before = size;
  }
  EXPECT_EQ(scaled_crater(0.001, 0.6, loam, kGravity).radius, 0);
  EXPECT_EQ(scaled_crater(0.001, 50, loam, kGravity).radius, 0);
}

TEST(LawsCrater, NothingJumpsAtTheGround) {
  const Medium loam = soil(0.4, 0.2);
  const CraterSize at = scaled_crater(1, 0, loam, kGravity);
  for (const double height : {-1e-6, 1e-6}) {
    const CraterSize near = scaled_crater(1, height, loam, kGravity);
    EXPECT_NEAR(near.radius, at.radius, 1e-4);
    EXPECT_NEAR(near.depth, at.depth, 1e-4);
    EXPECT_NEAR(near.lip_share, at.lip_share, 1e-4);
  }
}

// Chemical charges in alluvium and basalt [Nordyke 1961] and in ConWep's soil: apparent radii and depths. One law, each
// ground known by its craters at the surface alone; shots in one ground scatter by 10 to 30 %.
TEST(LawsCrater, BuriedChargesAsMeasured) {
  const Medium alluvium = soil(0.297, 0.149, 1700), basalt = soil(0.17, 0.098, 2650), loam = soil(0.4, 0.2, 1750);
  struct Shot {
    const char* name;
    const Medium& ground;
    double tons, buried, radius, depth;
  };
  for (const Shot& shot : {Shot{"Stagecoach II", alluvium, 18.144, 5.2121, 15.39, 7.19},
                           {"Stagecoach III", alluvium, 18.144, 10.424, 17.83, 8.90},
                           {"Stagecoach I", alluvium, 18.144, 24.384, 17.37, 2.41},
                           {"Scooter", alluvium, 453.59, 38.1, 46.94, 22.86},
                           {"Buckboard 11", basalt, 18.144, 7.7724, 13.65, 7.59},
                           {"Buckboard 12", basalt, 18.144, 13.015, 17.37, 10.58},
                           {"Buckboard 13", basalt, 18.144, 17.922, 11.22, 4.94},
                           {"Pre-Schooner II", basalt, 85.321, 21.641, 29.02, 18.50},
                           {"ConWep 488 lb", loam, 0.22135, 5.4864, 4.51, 2.75}}) {
    const CraterSize size = scaled_crater(shot.tons, -shot.buried, shot.ground, kGravity);
    EXPECT_NEAR(0.96 * size.radius, shot.radius, 0.25 * shot.radius) << shot.name;  // at 5 % of the depth
    EXPECT_NEAR(size.depth, shot.depth, 0.3 * shot.depth) << shot.name;
  }
}

// What is thrown from deep falls back into large craters and clears small ones, and nothing falls where nothing weighs.
TEST(LawsCrater, LargeDeepCratersAreFilled) {
  const Medium alluvium = soil(0.297, 0.149, 1700);
  const auto aspect = [&](double tons, double gravity) {
    const CraterSize size = scaled_crater(tons, -0.8 * std::cbrt(1000 * tons), alluvium, gravity);
    return size.depth / size.radius;
  };
  const CraterSize surface = scaled_crater(1, 0, alluvium, 0);
  EXPECT_NEAR(aspect(0.001, kGravity), surface.depth / surface.radius, 0.01);
  for (double tons = 0.001; tons < 1e4; tons *= 10) EXPECT_LT(aspect(10 * tons, kGravity), aspect(tons, kGravity));
  EXPECT_LT(aspect(1000, kGravity), 0.1);
  EXPECT_NEAR(aspect(1000, 0), surface.depth / surface.radius, 1e-9);
}

TEST(LawsCrater, ProfileIsThePressuresExcess) {
  EXPECT_EQ(crater_profile(0, 0, 3), 1);
  EXPECT_NEAR(crater_profile(3, 0, 3), 0, 1e-12);
  EXPECT_EQ(crater_profile(3.1, 0, 3), 0);
  const double source = 3 * kSourceHeight, x2 = 2 * 2 + source * source, edge2 = 9 + source * source;
  const auto pressure = [](double square) { return 1 / (square * square); };
  EXPECT_NEAR(crater_profile(2, 0, 3), (pressure(x2) - pressure(edge2)) / (pressure(source * source) - pressure(edge2)),
              1e-12);
  EXPECT_GT(crater_profile(3, 1, 3), 0) << "a wall beside the charge is nearer to it";
}

TEST(LawsCrater, WhatCannotBeCompactedLeaves) {
  const CraterSize size{.radius = 4, .depth = 2, .lip_share = 0.185};
  const double pi = std::numbers::pi, volume = 0.45 * pi * 4 * 4 * 2, around = 2.0 / 3 * pi * 10 * 10 * 10;
  EXPECT_EQ(leaving_share(size, 0, 0.03), 0.185) << "soil takes it all";
  EXPECT_NEAR(leaving_share(size, 0, 0.01), 1 - 0.01 * around / volume, 1e-12) << "rock some of it";
  EXPECT_LT(leaving_share(size, 1, 0.01), leaving_share(size, 0, 0.01)) << "more the deeper the charge lies";
  EXPECT_EQ(leaving_share(size, 0, 0), 1) << "none";
}

TEST(LawsCrater, EjectaLieHighOnTheLipAndThinBeyond) {
  EXPECT_EQ(ejecta_profile(1), 0);
  EXPECT_NEAR(ejecta_profile(1.12), 1, 1e-9);
  EXPECT_NEAR(ejecta_profile(2.1) / ejecta_profile(1.9), std::pow(2.1 / 1.9, -3.86), 1e-9) << "[DNA 1984]";
  double before = ejecta_profile(1.0);
  for (double ratio = 1; ratio < 2.14; ratio += 0.001) {
    EXPECT_NEAR(ejecta_profile(ratio), before, 0.013) << "no jump at " << ratio;
    before = ejecta_profile(ratio);
  }
  EXPECT_EQ(ejecta_profile(2.15), 0);
}

}  // namespace
}  // namespace divot::laws
