#include "validation/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

namespace divot::validation {
namespace {

using Rows = std::vector<std::vector<std::string>>;

// Cells of one file by the name of their column.
class Table {
 public:
  static Result<Table> read(const std::string& folder, const char* name, const std::vector<std::string>& columns) {
    Table table;
    table.path_ = (std::filesystem::path(folder) / name).string();
    std::ifstream in(table.path_, std::ios::binary);
    if (!in) return fail({.file = table.path_, .problem = "cannot be read", .expected = "measured data"});
    std::ostringstream text;
    text << in.rdbuf();
    table.rows_ = parse_csv(text.str());
    for (const std::string& column : columns)
      if (table.rows_.empty() || table.column(column) == table.rows_[0].size())
        return fail({.file = table.path_, .line = 1, .problem = fmt::format("has no column \"{}\"", column)});
    return table;
  }

  std::size_t size() const { return rows_.size() - 1; }
  std::string text(std::size_t row, const std::string& name) const {
    const std::size_t k = column(name);
    return k < rows_[row + 1].size() ? rows_[row + 1][k] : "";
  }
  double number(std::size_t row, const std::string& name) const {
    const std::string cell = text(row, name);
    return cell.empty() ? std::numeric_limits<double>::quiet_NaN() : std::strtod(cell.c_str(), nullptr);
  }

 private:
  std::size_t column(const std::string& name) const {
    return static_cast<std::size_t>(std::find(rows_[0].begin(), rows_[0].end(), name) - rows_[0].begin());
  }
  std::string path_;
  Rows rows_;
};

}  // namespace

Rows parse_csv(const std::string& text) {
  Rows rows;
  std::vector<std::string> row;
  std::string cell;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      cell += '"', ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && (c == ',' || c == '\n')) {
      row.push_back(std::move(cell));
      cell.clear();
      if (c == '\n') rows.push_back(std::move(row)), row.clear();
    } else if (c != '\r') {
      cell += c;
    }
  }
  if (!cell.empty() || !row.empty()) {
    row.push_back(std::move(cell));
    rows.push_back(std::move(row));
  }
  return rows;
}

Result<std::vector<MeasuredCrater>> measured_craters(const std::string& folder) {
  const auto table =
      Table::read(folder, "craters.csv",
                  {"shot", "kind", "medium", "material", "source", "charge_kg", "hob_m", "diameter_m", "depth_m"});
  if (!table) return tl::unexpected(table.error());
  std::vector<MeasuredCrater> craters;
  for (std::size_t row = 0; row < table->size(); ++row)
    craters.push_back({.shot = table->text(row, "shot"),
                       .kind = table->text(row, "kind"),
                       .medium = table->text(row, "medium"),
                       .material = table->text(row, "material"),
                       .source = table->text(row, "source"),
                       .charge = table->number(row, "charge_kg"),
                       .height = table->number(row, "hob_m"),
                       .diameter = table->number(row, "diameter_m"),
                       .depth = table->number(row, "depth_m")});
  return craters;
}

Result<std::vector<MeasuredSoil>> measured_soils(const std::string& folder) {
  const auto table = Table::read(
      folder, "soils.csv",
      {"terrain", "moisture_pct", "n", "kc_kN_m_np1", "kphi_kN_m_np2", "c_kPa", "phi_deg", "K_janosi_m", "source"});
  if (!table) return tl::unexpected(table.error());
  std::vector<MeasuredSoil> soils;
  for (std::size_t row = 0; row < table->size(); ++row)
    soils.push_back({.terrain = table->text(row, "terrain"),
                     .source = table->text(row, "source"),
                     .moisture = table->number(row, "moisture_pct"),
                     .n = table->number(row, "n"),
                     .kc = 1e3 * table->number(row, "kc_kN_m_np1"),
                     .kphi = 1e3 * table->number(row, "kphi_kN_m_np2"),
                     .cohesion = 1e3 * table->number(row, "c_kPa"),
                     .friction_angle_deg = table->number(row, "phi_deg"),
                     .shear_modulus = table->number(row, "K_janosi_m")});
  return soils;
}

Result<MeasuredSoil> find_soil(const std::vector<MeasuredSoil>& soils, const std::string& terrain, double moisture) {
  for (const MeasuredSoil& soil : soils)
    if (soil.terrain == terrain && (moisture == 0 || soil.moisture == moisture)) return soil;
  return fail({.file = "soils.csv", .problem = fmt::format("has no \"{}\" of {:g} % moisture", terrain, moisture)});
}

Material material_of(const MeasuredSoil& soil) {
  Material material = *find_preset("dry_sand");
  material.name = "measured";
  material.bekker_kc = soil.kc;
  material.bekker_kphi = soil.kphi;
  material.bekker_n = soil.n;
  if (!std::isnan(soil.cohesion)) material.cohesion = soil.cohesion;
  if (!std::isnan(soil.friction_angle_deg)) material.friction_angle_deg = soil.friction_angle_deg;
  if (!std::isnan(soil.shear_modulus)) material.shear_modulus = soil.shear_modulus;
  return material;
}

}  // namespace divot::validation
