#include "scene/bounds.h"
#include "scene/describe.h"

namespace divot::scene {
namespace {

void describe_particles(Visitor& v, Material& m) {
  v.number({.name = "reference_spacing",
            .unit = "m",
            .range = above(0, kLong),
            .meaning = "spacing that mass, `e0` and damping are given for"},
           m.reference_spacing);
  v.number({.name = "particle_mass", .unit = "kg", .range = above(0, kHeavy), .meaning = "of one surface particle"},
           m.particle_mass);
  v.number({.name = "e0",
            .unit = "J",
            .range = between(0, kHeavy),
            .meaning = "dissociation energy of eq. 6",
            .field = "dissociation_energy"},
           m.dissociation_energy);
  v.number({.name = "m",
            .range = above(0, 20),
            .meaning = "exponent of attraction of eq. 6",
            .field = "attraction_exponent"},
           m.attraction_exponent);
  v.number({.name = "n",
            .range = above(0, 20),
            .meaning = "exponent of repulsion of eq. 6, above `m`",
            .field = "repulsion_exponent"},
           m.repulsion_exponent);
  v.number({.name = "spring_stiffness",
            .unit = "N/m",
            .range = between(0, kHeavy),
            .meaning = "of eq. 1; used with `cohesion = \"mass_spring\"`"},
           m.spring_stiffness);
  v.number({.name = "yield_strain",
            .range = above(0, 10),
            .meaning = "bonds keep their length up to this strain and flow beyond it"},
           m.yield_strain);
  v.number({.name = "viscous_damping", .unit = "N s/m", .range = between(0, kHeavy), .meaning = "of eq. 2"},
           m.viscous_damping);
  v.number({.name = "global_damping", .unit = "kg/s", .range = between(0, kHeavy), .meaning = "of eq. 3"},
           m.global_damping);
}

void describe_ground(Visitor& v, Material& m) {
  v.flag({.name = "ground", .meaning = "`false`: the bare particle sheet of the paper, with nothing below it"},
         m.ground);
  v.number({.name = "kc",
            .unit = "N/m^(n+1)",
            .range = between(0, kHeavy),
            .meaning = "Bekker's cohesive modulus",
            .field = "bekker_kc"},
           m.bekker_kc);
  v.number({.name = "kphi",
            .unit = "N/m^(n+2)",
            .range = between(0, kHeavy),
            .meaning = "Bekker's frictional modulus; not 0 together with `kc`",
            .field = "bekker_kphi"},
           m.bekker_kphi);
  v.number({.name = "bekker_n", .range = above(0, 3), .meaning = "Bekker's exponent of sinkage"}, m.bekker_n);
  v.number(
      {.name = "elastic_stiffness", .unit = "Pa/m", .range = above(0, kHeavy), .meaning = "of unloading and reloading"},
      m.elastic_stiffness);
  v.number({.name = "ground_damping_ratio",
            .range = between(0, 100),
            .meaning = "of the ground under particles and bodies; 1 is critical"},
           m.ground_damping_ratio);
  v.number({.name = "cohesion", .unit = "Pa", .range = between(0, kHeavy), .meaning = "Mohr and Coulomb's c"},
           m.cohesion);
  v.number(
      {.name = "friction_angle_deg", .unit = "degrees", .range = between(0, 60), .meaning = "Mohr and Coulomb's phi"},
      m.friction_angle_deg);
  v.number({.name = "shear_modulus",
            .unit = "m",
            .range = above(0, kLong),
            .meaning = "Janosi and Hanamoto's K: shear displacement scale"},
           m.shear_modulus);
  v.number({.name = "restitution", .range = between(0, 1), .meaning = "multiplied by the body's"}, m.restitution);
}

void describe_loose_soil(Visitor& v, Material& m) {
  v.number(
      {.name = "density", .unit = "kg/m^3", .range = above(0, kHeavy), .meaning = "of soil that nothing has touched"},
      m.density);
  v.number({.name = "compaction_limit",
            .range = {.low = 0, .high = 1, .high_open = true},
            .meaning = "largest share of its volume that soil can lose by compaction"},
           m.compaction_limit);
  v.number({.name = "repose_angle_deg",
            .unit = "degrees",
            .range = above(0, 89),
            .meaning = "angle of repose: slopes of loose soil at rest are no steeper"},
           m.repose_angle_deg);
}

void describe_layer(Visitor& v, Material& m) {
  v.table({.name = "over", .example = "over = { material = \"clay_wet\", thickness = 0.1 }"}, [&] {
    v.text({.name = "material",
            .meaning = "what lies below this crust: a preset or a material of the file",
            .required = true},
           m.over);
    v.number({.name = "thickness", .unit = "m", .range = above(0, kLong), .meaning = "of the crust", .required = true},
             m.over_thickness);
  });
}

void describe_blast(Visitor& v, Material& m) {
  v.number({.name = "blast_strength",
            .unit = "Pa",
            .range = above(0, kHeavy),
            .meaning = "pressure the soil withstands; sets a crater's width"},
           m.blast_strength);
  v.number({.name = "blast_drag",
            .unit = "Pa s/m",
            .range = above(0, kHeavy),
            .meaning = "resistance of the soil that flows; sets a crater's depth"},
           m.blast_drag);
  v.number(
      {.name = "ejecta_share",
       .range = {.low = 0, .high = 1, .high_open = true},
       .meaning = "share of a surface crater's volume on lip and blanket; the rest is compacted as far as it can be"},
      m.ejecta_share);
}

void describe_look(Visitor& v, Material& m) {
  v.text({.name = "color", .meaning = "in pictures, as `#rrggbb`", .default_text = "up to what draws it"}, m.color);
  v.text({.name = "texture",
          .meaning = "PNG or JPEG picture that covers the ground in place of `color`; a relative path starts at the "
                     "scene's folder",
          .default_text = "none"},
         m.texture);
  v.number({.name = "texture_size",
            .unit = "m",
            .range = above(0, kLong),
            .meaning = "of ground that the picture covers each way"},
           m.texture_size);
}

}  // namespace

void describe(Visitor& v, Material& material) {
  describe_particles(v, material);
  describe_ground(v, material);
  describe_loose_soil(v, material);
  describe_layer(v, material);
  describe_blast(v, material);
  describe_look(v, material);
}

}  // namespace divot::scene
