#include "scene/soils.h"

// One table of measured soils. Sources by their short names, in full in docs/physics.md, "References":
// [Wong 2008]   Bekker and Mohr-Coulomb parameters of the soil named
// [KRC]         Keweenaw Research Center: plates pressed and released, the only unloading that was measured
// [Bowles 1996] range of the modulus of subgrade reaction of that kind of soil, for want of measured unloading
// [Glover]      angles of repose
// [Cardarelli]  densities
// [TM 5-855-1]  crater radius and depth over the cube root of the charge
// "e.v." is an engineering value: nobody measured it with the rest, what is said after it is why it is so.

namespace divot::scene {
namespace {

constexpr Soil kDrySand = {
    .name = "dry_sand",
    .density = 1600,               // [Cardarelli] dry quartz sand
    .kc = 0.99e3,                  // [Wong 2008] dry sand (LLL)
    .kphi = 1528.4e3,              // the same
    .n = 1.1,                      // the same
    .elastic_stiffness = 93.97e6,  // [KRC] fine grain dry, k0 of unloading
    .cohesion = 1.04e3,            // [Wong 2008] dry sand (LLL)
    .friction_angle_deg = 28,      // the same
    .shear_modulus = 0.02,         // e.v.: typical of sand
    .restitution = 0.1,            // e.v.: sand swallows a drop
    .compaction_limit = 0.1,       // e.v.: to some 1770 kg/m^3, as dense as sand is tamped
    .repose_angle_deg = 34,        // [Glover] dry sand
    .yield_strain = 0.02,          // e.v.: grains slide almost at once
    .crater_radius = 0.297,        // [TM 5-855-1] dry sand
    .crater_depth = 0.149,         // the same
};

constexpr Soil kLeteSand = {
    .name = "lete_sand",
    .density = 1600,               // [Cardarelli] dry quartz sand
    .kc = 102e3,                   // [Wong 2008] LETE sand
    .kphi = 5301e3,                // the same
    .n = 0.79,                     // the same
    .elastic_stiffness = 93.97e6,  // [KRC] fine grain dry, k0 of unloading
    .cohesion = 1.3e3,             // [Wong 2008] LETE sand
    .friction_angle_deg = 31.1,    // the same
    .shear_modulus = 0.012,        // e.v.: typical of this sand
    .restitution = 0.1,            // e.v.: as dry sand
    .compaction_limit = 0.08,      // e.v.: stiffer, so denser to begin with than dry sand
    .repose_angle_deg = 34,        // [Glover] dry sand
    .yield_strain = 0.02,          // e.v.: as dry sand
    .crater_radius = 0.297,        // [TM 5-855-1] dry sand
    .crater_depth = 0.149,         // the same
};

constexpr Soil kSandyLoam = {
    .name = "sandy_loam",
    .density = 1750,               // [Cardarelli] sandy soil, 8 % water
    .kc = 5.27e3,                  // [Wong 2008] sandy loam (LLL), 15 % water
    .kphi = 1515e3,                // the same
    .n = 0.7,                      // the same
    .elastic_stiffness = 93.97e6,  // [KRC] fine grain dry: the nearest that was measured
    .cohesion = 1.72e3,            // [Wong 2008] sandy loam (LLL), 15 % water
    .friction_angle_deg = 29,      // the same
    .shear_modulus = 0.02,         // e.v.: typical
    .restitution = 0.1,            // e.v.: as sand
    .compaction_limit = 0.2,       // Cranfield's sandy loam is tested from 1200 to 1600 kg/m^3: 25 % of its volume
    .repose_angle_deg = 37,        // [Glover] earth: 30 to 45
    .yield_strain = 0.03,          // e.v.: moist, between sand and mud
    .crater_radius = 0.40,         // [TM 5-855-1] generic soil
    .crater_depth = 0.20,          // the same
};

constexpr Soil kClayDry = {
    .name = "clay_dry",
    .density = 1700,   // e.v.: a firm clay at 22 % water
    .kc = 16.43e3,     // [Wong 2008] lean clay (WES), 22 % water
    .kphi = 1724.7e3,  // the same
    .n = 0.2,          // the same
    .elastic_stiffness =
        100e6,                 // [Bowles 1996] clay that carries over 800 kPa: above 48e6 under 0.3 m, e.v.: twice that
    .cohesion = 68.95e3,       // [Wong 2008] lean clay (WES), 22 % water
    .friction_angle_deg = 20,  // the same
    .shear_modulus = 0.006,    // e.v.: typical of firm clay
    .restitution = 0.2,        // e.v.: firm ground gives a little back
    .compaction_limit = 0.1,   // e.v.: what air it holds
    .repose_angle_deg = 35,    // [Glover] dry lumps of clay: 25 to 40
    .yield_strain = 0.02,      // e.v.: stiff and brittle
    .crater_radius = 0.389,    // [TM 5-855-1] dry sandy clay
    .crater_depth = 0.218,     // the same
};

constexpr Soil kClayWet = {
    .name = "clay_wet",
    .density = 1900,            // e.v.: saturated at 32 % water
    .kc = 1.52e3,               // [Wong 2008] lean clay (WES), 32 % water
    .kphi = 119.61e3,           // the same
    .n = 0.15,                  // the same
    .elastic_stiffness = 24e6,  // [Bowles 1996] clay that carries up to 200 kPa: 12e6 to 24e6
    .cohesion = 13.79e3,        // [Wong 2008] lean clay (WES), 32 % water
    .friction_angle_deg = 11,   // the same
    .shear_modulus = 0.03,      // e.v.: typical of wet clay
    .restitution = 0.1,         // e.v.: plastic
    .compaction_limit = 0.03,   // e.v.: pores full of water, which does not leave at once
    .repose_angle_deg = 15,     // [Glover] wet excavated clay
    .yield_strain = 0.05,       // e.v.: wet soil stretches further than dry before it flows
    .crater_radius = 0.456,     // [TM 5-855-1] wet clay
    .crater_depth = 0.228,      // the same
};

constexpr Soil kMud = {
    .name = "mud",
    .density = 1800,            // e.v.: sandy loam at 32 % water
    .kc = 0.77e3,               // [Wong 2008] sandy loam (Hanamoto), 32 % water
    .kphi = 51.91e3,            // the same
    .n = 0.5,                   // the same
    .elastic_stiffness = 10e6,  // e.v.: below the softest clay of [Bowles 1996]
    .cohesion = 5.17e3,         // [Wong 2008] sandy loam (Hanamoto), 32 % water
    .friction_angle_deg = 11,   // the same
    .shear_modulus = 0.02,      // e.v.: typical
    .restitution = 0.05,        // e.v.: mud swallows nearly all of a drop
    .compaction_limit = 0.03,   // e.v.: as wet clay
    .repose_angle_deg = 12,     // e.v.: little above its angle of friction
    .yield_strain = 0.05,       // e.v.: as wet clay
    .crater_radius = 0.456,     // [TM 5-855-1] wet clay
    .crater_depth = 0.228,      // the same
};

constexpr Soil kSnow = {
    .name = "snow",
    .density = 250,              // e.v.: settled; fresh snow has 70 to 150, firn 400 and more [AMS Glossary]
    .kc = 4.37e3,                // [Wong 2008] snow (U.S.)
    .kphi = 196.72e3,            // the same
    .n = 1.6,                    // the same
    .elastic_stiffness = 5e6,    // e.v.: some twenty times the slope of its curve at half a metre
    .cohesion = 1.03e3,          // [Wong 2008] snow (U.S.)
    .friction_angle_deg = 19.7,  // the same
    .shear_modulus = 0.03,       // e.v.: typical of snow
    .restitution = 0.05,         // e.v.: swallows nearly all of a drop
    .compaction_limit = 0.5,     // e.v.: wheels pack it to some 500 kg/m^3
    .repose_angle_deg = 38,      // [Glover] snow
    .yield_strain = 0.03,        // e.v.: bonds of ice break early
    .crater_radius = 0.5,        // e.v.: weaker than any soil
    .crater_depth = 0.25,        // e.v.: half the radius, as soils have it
    .ejecta_share = 0.1,         // e.v.: more of it is packed than thrown
};

constexpr Soil kWheatField = {
    .name = "wheat_field",
    .density = 1350,            // e.v.: tilled topsoil, between loam dry (1200) and moist (1600) [Cardarelli]
    .kc = 52.53e3,              // [Wong 2008] sandy loam (Michigan, Strong & Buchele), 11 % water: farmed soil
    .kphi = 1127.97e3,          // the same
    .n = 0.9,                   // the same
    .elastic_stiffness = 60e6,  // e.v.: between loam (94e6) and wet clay (24e6)
    .cohesion = 4.83e3,         // [Wong 2008] sandy loam (Michigan, Strong & Buchele), 11 % water
    .friction_angle_deg = 20,   // the same
    .shear_modulus = 0.02,      // e.v.: typical
    .restitution = 0.1,         // e.v.: as loam
    .compaction_limit = 0.25,   // Cranfield's sandy loam from 1200 to 1600 kg/m^3
    .repose_angle_deg = 40,     // [Glover] earth: 30 to 45, roots hold it
    .yield_strain = 0.05,       // e.v.: roots stretch
    .crater_radius = 0.40,      // [TM 5-855-1] generic soil
    .crater_depth = 0.20,       // the same
};

constexpr Soil kGravel = {
    .name = "gravel",
    .density = 1700,                // [Cardarelli] as wet sand; crushed rock as laid: 1500 to 2000
    .kc = 32.475e3,                 // [KRC] coarse pit
    .kphi = 931.8e3,                // the same
    .n = 0.4567,                    // the same
    .elastic_stiffness = 120.42e6,  // the same, k0 of unloading
    .cohesion = 1.56e3,             // the same
    .friction_angle_deg = 30.354,   // the same
    .shear_modulus = 0.0186,        // the same
    .restitution = 0.25,            // e.v.: between sand and rock
    .compaction_limit = 0.08,       // e.v.: lies nearly as dense as it gets
    .repose_angle_deg = 35,         // [Glover] loose dry gravel: 30 to 45
    .yield_strain = 0.02,           // e.v.: as sand
    .crater_radius = 0.297,         // e.v.: [TM 5-855-1] of dry sand, the nearest soil without cohesion
    .crater_depth = 0.149,          // the same
};

constexpr Soil kLunarRegolith = {
    .name = "lunar_regolith",
    .density = 1500,               // [Jaffe 1969] 1100 at the surface to 1600 at 5 cm
    .kc = 1.4e3,                   // lunar nominal soil [MER traverses]
    .kphi = 820e3,                 // the same
    .n = 1,                        // the same
    .elastic_stiffness = 93.97e6,  // [KRC] fine grain dry: e.v., nobody unloaded a plate there
    .cohesion = 0.17e3,            // lunar nominal soil [MER traverses]
    .friction_angle_deg = 35,      // the same
    .shear_modulus = 0.018,        // the usual figure of the Apollo years
    .restitution = 0.1,            // e.v.: as dry sand
    .compaction_limit = 0.25,      // e.v.: fluffy at the top, tamped some 1900 kg/m^3
    .repose_angle_deg = 36,        // Surveyor III's angle of friction, 35 to 37: loose, without cohesion
    .yield_strain = 0.02,          // e.v.: as dry sand
    .crater_radius = 0.297,        // e.v.: [TM 5-855-1] of dry sand; low gravity and vacuum are not in it
    .crater_depth = 0.149,         // the same
};

// The three that are no soils stand as stiff as 64 substeps of 1/60 s can follow. Real concrete and rock are stiffer
// still, and nobody sees a tenth of a millimetre.
constexpr Soil kAsphalt = {
    .name = "asphalt",
    .density = 2400,             // e.v.: a rolled mix
    .kc = 0,                     // e.v.: does not depend on the plate
    .kphi = 2.5e9,               // e.v.: a strong pavement bends 0.2 mm under a plate of 0.3 m with 40 kN
    .n = 1,                      // e.v.: linear
    .elastic_stiffness = 3.5e9,  // e.v.: a tyre at 0.7 MPa leaves 0.08 mm
    .cohesion = 1e6,             // e.v.: a bound mix at 20 degrees C
    .friction_angle_deg = 40,    // e.v.: interlocked crushed stone
    .shear_modulus = 0.001,      // e.v.: shears at 1 % of a layer of 0.1 m
    .restitution = 0.7,          // e.v.: a hard ball on a road
    .compaction_limit = 0.05,    // e.v.: the air a rolled mix still holds
    .repose_angle_deg = 40,      // [Glover] crushed asphalt: 30 to 45
    .yield_strain = 0.005,       // e.v.: cracks at a few tenths of a percent
    .crater_radius = 0.151,      // e.v.: [TM 5-855-1] of a concrete slab
    .crater_depth = 0.079,       // the same
};

constexpr Soil kConcrete = {
    .name = "concrete",
    .density = 2400,             // [Cardarelli]
    .kc = 0,                     // e.v.: does not depend on the plate
    .kphi = 3.2e9,               // e.v.: see above
    .n = 1,                      // e.v.: linear
    .elastic_stiffness = 3.5e9,  // e.v.: see above
    .cohesion = 2e6,             // e.v.: shears at less than a tenth of 30 MPa
    .friction_angle_deg = 45,    // e.v.: across a crack
    .shear_modulus = 0.0005,     // e.v.: brittle
    .restitution = 0.8,          // e.v.: a hard ball on a floor
    .compaction_limit = 0.01,    // e.v.: hardly a pore that closes
    .repose_angle_deg = 45,      // [Glover] crushed stone: 45
    .yield_strain = 0.003,       // e.v.: crushes at 3 parts in a thousand
    .crater_radius = 0.151,      // [TM 5-855-1] concrete slab
    .crater_depth = 0.079,       // the same
};

constexpr Soil kRock = {
    .name = "rock",
    .density = 2650,             // [Cardarelli] granite
    .kc = 0,                     // e.v.: does not depend on the plate
    .kphi = 3.3e9,               // e.v.: see above
    .n = 1,                      // e.v.: linear
    .elastic_stiffness = 3.5e9,  // e.v.: see above
    .cohesion = 1e6,             // e.v.: jointed rock; intact pieces have 7 to 66 MPa [Goodman 1980]
    .friction_angle_deg = 45,    // [Goodman 1980] sandstone to granite: 28 to 51
    .shear_modulus = 0.0005,     // e.v.: as concrete
    .restitution = 0.8,          // e.v.: as concrete
    .compaction_limit = 0.01,    // e.v.: as concrete
    .repose_angle_deg = 45,      // [Glover] crushed stone
    .yield_strain = 0.003,       // e.v.: as concrete
    .crater_radius = 0.17,       // [DNA 1984] hard and dry soft rock: 0.40 and 0.46 of dry soil's 0.40
    .crater_depth = 0.098,       // e.v.: as deep for its width as clay and concrete
};

constexpr Soil kAll[] = {kDrySand,    kLeteSand, kSandyLoam,     kClayDry, kClayWet,  kMud, kSnow,
                         kWheatField, kGravel,   kLunarRegolith, kAsphalt, kConcrete, kRock};

}  // namespace

std::span<const Soil> measured_soils() { return kAll; }

}  // namespace divot::scene
