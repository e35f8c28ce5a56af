#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "divot/material.h"

namespace divot::cli {
namespace {

using Json = nlohmann::ordered_json;

// A number of a material under the name that scene files give it.
struct Field {
  const char* key;
  const char* unit;
  double Material::*value;
};

constexpr Field kFields[] = {{"reference_spacing", "m", &Material::reference_spacing},
                             {"particle_mass", "kg", &Material::particle_mass},
                             {"e0", "J", &Material::dissociation_energy},
                             {"m", "", &Material::attraction_exponent},
                             {"n", "", &Material::repulsion_exponent},
                             {"spring_stiffness", "N/m", &Material::spring_stiffness},
                             {"yield_strain", "", &Material::yield_strain},
                             {"viscous_damping", "N s/m", &Material::viscous_damping},
                             {"global_damping", "kg/s", &Material::global_damping},
                             {"kc", "N/m^(n+1)", &Material::bekker_kc},
                             {"kphi", "N/m^(n+2)", &Material::bekker_kphi},
                             {"bekker_n", "", &Material::bekker_n},
                             {"elastic_stiffness", "Pa/m", &Material::elastic_stiffness},
                             {"ground_damping_ratio", "", &Material::ground_damping_ratio},
                             {"cohesion", "Pa", &Material::cohesion},
                             {"friction_angle_deg", "degrees", &Material::friction_angle_deg},
                             {"shear_modulus", "m", &Material::shear_modulus},
                             {"restitution", "", &Material::restitution},
                             {"density", "kg/m^3", &Material::density},
                             {"compaction_limit", "", &Material::compaction_limit},
                             {"repose_angle_deg", "degrees", &Material::repose_angle_deg},
                             {"blast_strength", "Pa", &Material::blast_strength},
                             {"blast_drag", "Pa s/m", &Material::blast_drag},
                             {"ejecta_share", "", &Material::ejecta_share}};

Json to_json(const Material& material) {
  Json out = {{"name", material.name}};
  for (const Field& field : kFields) out[field.key] = material.*field.value;
  out["ground"] = material.ground;
  return out;
}

void print_json() {
  Json units = Json::object(), materials = Json::array();
  for (const Field& field : kFields)
    if (*field.unit != '\0') units[field.key] = field.unit;
  for (const Material& material : material_presets()) materials.push_back(to_json(material));
  fmt::print("{}\n", Json{{"units", units}, {"materials", materials}}.dump(2));
}

template <class Cell>
void print_row(const char* key, const char* unit, Cell cell) {
  fmt::print("{:<21}{:<11}", key, unit);
  for (const Material& material : material_presets()) fmt::print("{:>11}", cell(material));
  fmt::print("\n");
}

void print_table() {
  print_row("", "unit", [](const Material& m) { return m.name; });
  for (const Field& field : kFields)
    print_row(field.key, field.unit, [&](const Material& m) { return fmt::format("{:.4g}", m.*field.value); });
  print_row("ground", "", [](const Material& m) { return m.ground; });
}

}  // namespace

int materials(const MaterialsOptions& options) {
  options.json ? print_json() : print_table();
  return kDone;
}

}  // namespace divot::cli
