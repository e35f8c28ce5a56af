#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "divot/material.h"

namespace divot {
namespace {

std::string first_key(const Material& material) {
  const Errors errors = check(material);
  return errors.empty() ? "" : errors.front().key;
}

TEST(Materials, PresetsAreFoundByNameAndAreInRange) {
  const char* names[] = {"paper", "dry_sand",    "lete_sand", "sandy_loam",     "clay_dry", "clay_wet", "mud",
                         "snow",  "wheat_field", "gravel",    "lunar_regolith", "asphalt",  "concrete", "rock"};
  ASSERT_EQ(material_presets().size(), std::size(names));
  for (const char* name : names) {
    const Material* preset = find_preset(name);
    ASSERT_NE(preset, nullptr) << name;
    EXPECT_EQ(preset->name, name);
    for (const Error& error : check(*preset)) ADD_FAILURE() << name << ": " << error.text();
  }
  EXPECT_EQ(find_preset("granite"), nullptr);
  EXPECT_EQ(find_preset(""), nullptr);
}

TEST(Materials, PaperIsTheStructsDefault) {
  const Material* paper = find_preset("paper");
  const Material defaults;
  EXPECT_EQ(paper->name, defaults.name);
  EXPECT_EQ(paper->particle_mass, defaults.particle_mass);
  EXPECT_EQ(paper->dissociation_energy, defaults.dissociation_energy);
  EXPECT_EQ(paper->blast_strength, defaults.blast_strength);
  EXPECT_EQ(paper->blast_drag, defaults.blast_drag);
}

TEST(Materials, SoilsKeepTheirMeasuredOrder) {
  const Material &sand = *find_preset("dry_sand"), &mud = *find_preset("mud"), &asphalt = *find_preset("asphalt");
  // Sinkage under 50 kPa and a plate 0.1 m wide, as Wong's parameters give it.
  // It is elastic where that is softer, as at the start of clay's curve.
  const auto sinkage = [](const Material& m) {
    return std::max(std::pow(50e3 / (m.bekker_kc / 0.1 + m.bekker_kphi), 1 / m.bekker_n), 50e3 / m.elastic_stiffness);
  };
  EXPECT_NEAR(sinkage(sand), 0.0444, 0.0001);
  EXPECT_NEAR(sinkage(mud), 0.7036, 0.0001);
  EXPECT_LT(sinkage(asphalt), 0.001);
  // From weak to strong, as a wheel feels them.
  const char* order[] = {"mud", "snow", "sandy_loam", "gravel", "clay_dry", "asphalt", "concrete"};
  for (std::size_t i = 1; i < std::size(order); ++i)
    EXPECT_GT(sinkage(*find_preset(order[i - 1])), sinkage(*find_preset(order[i]))) << order[i];
}

// Where the elastic branch were softer than Bekker's curve, nothing would stay. Under a load of 0.7 MPa, a lorry's
// tyre, what is left must be a part of the sinkage: a small one of the hard three, a large one of soils.
TEST(Materials, UnloadingIsStifferThanLoading) {
  for (const Material& m : material_presets()) {
    if (m.name == "paper") continue;
    const double p = 0.7e6, z = std::pow(p / (m.bekker_kc / 0.15 + m.bekker_kphi), 1 / m.bekker_n);
    const double stays = std::max(0.0, z - p / m.elastic_stiffness);
    const bool hard = m.name == "asphalt" || m.name == "concrete" || m.name == "rock";
    if (hard) {
      EXPECT_LT(stays, 1e-4) << m.name;
    }
    if (m.name == "mud" || m.name == "snow" || m.name == "wheat_field") {
      EXPECT_GT(stays, 0.8 * z) << m.name;
    }
    EXPECT_GT(m.elastic_stiffness, m.bekker_n * p / std::max(z, 0.01)) << m.name;
  }
}

// What a lorry's wheel of 12 kN on a patch 0.15 m in radius leaves .
TEST(Materials, AsphaltBarelyMovesAndMudYields) {
  const auto rut = [](const char* name) {
    const Material& m = *find_preset(name);
    const double p = 170e3;
    return std::pow(p / (m.bekker_kc / 0.15 + m.bekker_kphi), 1 / m.bekker_n) - p / m.elastic_stiffness;
  };
  EXPECT_LT(rut("asphalt"), 1e-3);
  EXPECT_GT(rut("mud"), 0.05);
  EXPECT_GT(rut("wheat_field"), 0.05);
}

TEST(Materials, BlastKeysFollowMeasuredCraters) {
  const Material& paper = *find_preset("paper");
  const struct {
    const char* name;
    double radius, depth;  // over the cube root of the charge, m/kg^(1/3)
  } measured[] = {{"dry_sand", 0.297, 0.149}, {"clay_dry", 0.389, 0.218}, {"clay_wet", 0.456, 0.228},
                  {"concrete", 0.151, 0.079}, {"sandy_loam", 0.40, 0.20}, {"mud", 0.456, 0.228}};
  for (const auto& crater : measured) {
    const Material& soil = *find_preset(crater.name);
    const double radius = 0.3566 * std::cbrt(paper.blast_strength / soil.blast_strength);
    const double flow = (soil.blast_strength / paper.blast_strength) / (soil.blast_drag / paper.blast_drag);
    EXPECT_NEAR(radius, crater.radius, 1e-9) << crater.name;
    EXPECT_NEAR(0.143 * flow, crater.depth, 1e-9) << crater.name;
  }
}

TEST(Materials, CheckNamesTheFieldThatIsWrong) {
  EXPECT_EQ(first_key({.particle_mass = 0}), "particle_mass");
  EXPECT_EQ(first_key({.dissociation_energy = -1}), "dissociation_energy");
  EXPECT_EQ(first_key({.repulsion_exponent = 2}), "repulsion_exponent");
  EXPECT_EQ(first_key({.bekker_kphi = 0}), "bekker_kphi");
  EXPECT_EQ(first_key({.ground = false, .bekker_kphi = 0}), "");
  EXPECT_EQ(first_key({.bekker_n = 3.5}), "bekker_n");
  EXPECT_EQ(first_key({.friction_angle_deg = 61}), "friction_angle_deg");
  EXPECT_EQ(first_key({.density = 0}), "density");
  EXPECT_EQ(first_key({.compaction_limit = 1}), "compaction_limit");
  EXPECT_EQ(first_key({.repose_angle_deg = 90}), "repose_angle_deg");
  EXPECT_EQ(first_key({.over = "mud", .over_thickness = 0}), "over.thickness");
  EXPECT_EQ(first_key({.ejecta_share = 1}), "ejecta_share");
  EXPECT_EQ(first_key({.cohesion = std::numeric_limits<double>::quiet_NaN()}), "cohesion");
  EXPECT_EQ(first_key({.elastic_stiffness = std::numeric_limits<double>::infinity()}), "elastic_stiffness");
  EXPECT_EQ(check(Material{.particle_mass = -1, .yield_strain = 0, .restitution = 2}).size(), 3u);
}

}  // namespace
}  // namespace divot
