#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

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
                             {"ejecta_share", "", &Material::ejecta_share},
                             {"texture_size", "m", &Material::texture_size}};

Json to_json(const Material& material) {
  Json out = {{"name", material.name}};
  for (const Field& field : kFields) out[field.key] = material.*field.value;
  out["ground"] = material.ground;
  out["color"] = material.color;
  out["texture"] = material.texture;
  return out;
}

void print_json() {
  Json units = Json::object(), materials = Json::array();
  for (const Field& field : kFields)
    if (*field.unit != '\0') units[field.key] = field.unit;
  for (const Material& material : material_presets()) materials.push_back(to_json(material));
  fmt::print("{}\n", Json{{"units", units}, {"materials", materials}}.dump(2));
}

// Four digits, and 1.528e6 instead of 1.528e+06.
std::string short_number(double value) {
  std::string text = fmt::format("{:.4g}", value);
  if (const auto e = text.find('e'); e != std::string::npos) {
    while (text[e + 1] == '+' || text[e + 1] == '0') text.erase(e + 1, 1);
  }
  return text;
}

template <class Cell>
void print_row(const char* key, const char* unit, std::span<const Material> materials, Cell cell) {
  fmt::print("{:<21}{:<11}", key, unit);
  for (const Material& material : materials)
    fmt::print("{:>{}}", cell(material), std::max<std::size_t>(material.name.size() + 2, 9));
  fmt::print("\n");
}

// Seven presets side by side are as many as a terminal of 110 columns holds.
void print_table() {
  constexpr std::size_t kSideBySide = 7;
  for (std::span<const Material> left = material_presets(); !left.empty();) {
    const std::span<const Material> now = left.first(std::min(kSideBySide, left.size()));
    print_row("", "unit", now, [](const Material& m) { return m.name; });
    for (const Field& field : kFields)
      print_row(field.key, field.unit, now, [&](const Material& m) { return short_number(m.*field.value); });
    print_row("ground", "", now, [](const Material& m) { return m.ground ? "true" : "false"; });
    print_row("color", "", now, [](const Material& m) { return m.color.empty() ? "-" : m.color; });
    print_row("texture", "", now, [](const Material& m) { return m.texture.empty() ? "-" : m.texture; });
    left = left.subspan(now.size());
    if (!left.empty()) fmt::print("\n");
  }
}

}  // namespace

int materials(const MaterialsOptions& options) {
  options.json ? print_json() : print_table();
  return kDone;
}

}  // namespace divot::cli
