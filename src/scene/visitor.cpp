#include "scene/visitor.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace divot::scene {

bool Range::contains(double value) const {
  if (!std::isfinite(value)) return false;
  return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string Range::text() const {
  std::string out;
  if (std::isfinite(low)) out = (low_open ? "> " : ">= ") + number_text(low);
  if (std::isfinite(high)) {
    if (!out.empty()) out += " and ";
    out += (high_open ? "< " : "<= ") + number_text(high);
  }
  return out;
}

void Visitor::push(const std::string& path) {
  outer_.push_back(path_);
  path_ = path;
}

void Visitor::pop() {
  path_ = outer_.back();
  outer_.pop_back();
}

std::vector<std::string> HeldVisitor::material_names(std::span<const Material> current) {
  std::vector<std::string> names;
  for (const Material& material : current) names.push_back(material.name);
  return names;
}

std::string number_text(double value, int digits) {
  if (std::fabs(value) < 1e7 && value == std::floor(value)) return fmt::format("{:.0f}", value);
  // Six digits where they say it all, which makes 1e12 of 1000000000000; otherwise as many as it takes.
  std::string out = fmt::format("{:.{}g}", value, digits > 0 ? digits : 6);
  if (digits == 0 && std::strtod(out.c_str(), nullptr) != value) out = fmt::format("{}", value);
  // 1e9 and 1e-9, not 1e+09 and 1e-09.
  if (const auto e = out.find('e'); e != std::string::npos) {
    if (out[e + 2] == '0') out.erase(e + 2, 1);
    if (out[e + 1] == '+') out.erase(e + 1, 1);
  }
  return out;
}

std::string one_of(std::span<const std::string> names) {
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) out += i + 1 < names.size() ? ", " : " or ";
    out += '"' + names[i] + '"';
  }
  return out;
}

std::string one_of(Names names) {
  const std::vector<std::string> copies(names.begin(), names.end());
  return one_of(std::span<const std::string>(copies));
}

std::string expectation(const std::string& type, const Key& key) {
  std::string out = "expected " + type;
  if (const std::string range = key.range.text(); !range.empty()) out += " " + range;
  if (key.unit[0] != '\0') out += fmt::format(" ({})", key.unit);
  return out;
}

}  // namespace divot::scene
