#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "scene/reader.h"

namespace divot::scene {
namespace {

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The base that the file names for a material, or nothing.
std::optional<std::string> base_of(const toml::table& materials, const std::string& name) {
  return materials[name]["base"].value<std::string>();
}

/// A legend's key: an integer, or `#` and six hexadecimal digits.
std::optional<LegendEntry> pixel_of(std::string_view key) {
  LegendEntry entry{.color = !key.empty() && key[0] == '#'};
  const std::string_view digits = entry.color ? key.substr(1) : key;
  const char* end = digits.data() + digits.size();
  const auto [stop, code] = std::from_chars(digits.data(), end, entry.pixel, entry.color ? 16 : 10);
  const bool whole = code == std::errc{} && stop == end && !digits.empty();
  if (!whole || (entry.color && (digits.size() != 6 || entry.pixel < 0))) return std::nullopt;
  return entry;
}

}  // namespace

void Reader::legend(const Key& key, std::vector<LegendEntry>& entries) {
  const std::string expected = "expected a table as { 0 = \"field\", 255 = \"asphalt\" }";
  const toml::node* node = find(key, expected);
  if (node == nullptr) return;
  const toml::table* table = node->as_table();
  if (table == nullptr) return error_at(node, path_to(key.name), described(*node), expected);
  if (table->empty()) return error_at(node, path_to(key.name), "is empty", expected);
  entries.clear();
  for (const auto& [pixel, name] : *table) {
    std::optional<LegendEntry> entry = pixel_of(pixel.str());
    const std::string path = path_to(key.name) + "." + (entry ? entry->text() : std::string(pixel.str()));
    places_[path] = name.source();
    const auto* material = name.as_string();
    if (!entry) {
      error_at(&name, path, "no value of a pixel", "expected an integer, or a colour as \"#8a6f4d\"");
    } else if (material == nullptr) {
      error_at(&name, path, described(name), "expected the name of a material in quotes");
    } else {
      entry->material = material->get();
      entries.push_back(std::move(*entry));
    }
  }
}

std::vector<std::string> Reader::material_names(std::span<const Material>) {
  const toml::table* table = frames_.back().table;
  std::vector<std::string> ordered;
  if (table == nullptr) return ordered;
  for (const auto& entry : *table) {
    // From the material down to what it stands on, as long as that is in the file and not ordered yet. A material that
    // is based on its own name means the preset.
    std::vector<std::string> chain;
    std::string name(entry.first.str());
    bool ends = false;
    while (!ends && table->contains(name) && !holds(ordered, name) && !holds(chain, name)) {
      chain.push_back(name);
      const auto base = base_of(*table, name);
      ends = !base || (*base == name && find_preset(name) != nullptr);
      if (!ends) name = *base;
    }
    if (!ends && holds(chain, name)) {
      const auto first = std::find(chain.begin(), chain.end(), name);
      circular_.insert(circular_.end(), first, chain.end());
      error_at((*table)[*first]["base"].node(), path_to(*first) + ".base",
               fmt::format("goes in a circle: {} -> {}", fmt::join(first, chain.end(), " -> "), name),
               "expected a chain of materials that ends at a preset");
    }
    ordered.insert(ordered.end(), chain.rbegin(), chain.rend());
  }
  return ordered;
}

void Reader::base(const Key& key, Material& material, std::span<const Material> earlier) {
  const std::string name = material.name;
  const auto start_from = [&](const Material& start) {
    material = start;
    material.name = name;
  };
  const Material* same = find_preset(name);
  start_from(same != nullptr ? *same : *find_preset("paper"));

  std::string base;
  text(key, base);
  const toml::node* node = peek(key.name);
  if (node == nullptr || !node->is_string() || holds(circular_, name)) return;
  for (const Material& other : earlier) {
    if (other.name == base) return start_from(other);
  }
  if (const Material* preset = find_preset(base)) return start_from(*preset);

  std::vector<std::string> known;
  for (const Material& other : earlier) known.push_back(other.name);
  for (const Material& preset : material_presets()) known.push_back(preset.name);
  error_at(node, path_to(key.name), fmt::format("there is no material {}", quoted(base)),
           "expected " + one_of(std::span<const std::string>(known)));
}

}  // namespace divot::scene
