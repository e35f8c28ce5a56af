#include "scene/overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace divot::scene {
namespace {

/// One part of a dotted path: `bodies.0` and `bodies[0]` have the same two parts.
struct Part {
  std::string text;
  bool bracket = false;
};

/// The parts of a path, or nothing where it is not one.
std::optional<std::vector<Part>> split(std::string_view key) {
  std::vector<Part> parts;
  while (true) {
    const std::size_t end = std::min(key.find_first_of(".["), key.size());
    if (end == 0) return std::nullopt;
    parts.push_back({std::string(key.substr(0, end))});
    key.remove_prefix(end);
    while (!key.empty() && key[0] == '[') {
      const std::size_t close = key.find(']');
      if (close == std::string_view::npos || close == 1) return std::nullopt;
      parts.push_back({std::string(key.substr(1, close - 1)), true});
      key.remove_prefix(close + 1);
    }
    if (key.empty()) return parts;
    if (key[0] != '.') return std::nullopt;
    key.remove_prefix(1);
  }
}

std::string joined(std::span<const Part> parts) {
  std::string out;
  for (const Part& part : parts) out += (out.empty() ? "" : ".") + part.text;
  return out;
}

std::optional<std::size_t> index_in(const Part& part) {
  std::size_t index = 0;
  const char* end = part.text.data() + part.text.size();
  const auto [stop, code] = std::from_chars(part.text.data(), end, index);
  if (code != std::errc{} || stop != end) return std::nullopt;
  return index;
}

/// Whether `value` alone is a TOML value, and nothing follows it.
bool is_value(const std::string& value) {
  const auto parsed = parse_toml(fmt::format("value = {}", value), "");
  return parsed && parsed->size() == 1;
}

/// A document of one value at `parts`.
Result<toml::table> document_of(std::span<const Part> parts, const Override& override) {
  std::string text;
  for (const Part& part : parts) text += fmt::format("{}{}", text.empty() ? "" : ".", quoted(part.text));
  const std::string value = is_value(override.value) ? override.value : quoted(override.value);
  return parse_toml(fmt::format("{} = {}", text, value), source_of(override));
}

std::string size_text(std::size_t size) {
  if (size == 0) return "expected no index: the list is empty";
  return size == 1 ? "expected 0, its only element" : fmt::format("expected 0 to {}", size - 1);
}

/// Where in a document a path's value goes: into `container`, as the path's part `depth` and those below it.
struct Slot {
  toml::node* container;
  std::size_t depth;
};

/// What a part of a path stands for in `container`; null for a key that a table does not hold.
Result<toml::node*> child(toml::node& container, const Part& part, const std::string& path) {
  if (toml::array* list = container.as_array()) {
    const auto index = index_in(part);
    if (!index) {
      return fail({{}, 0, {}, path + " is a list", "expected an index instead of " + quoted(part.text)});
    }
    if (*index >= list->size()) {
      return fail({{}, 0, {}, fmt::format("{} has no element {}", path, *index), size_text(list->size())});
    }
    return list->get(*index);
  }
  toml::table* table = container.as_table();
  if (table == nullptr) {
    return fail({{}, 0, {}, fmt::format("{}: {}", path, described(container)), "expected a table or list there"});
  }
  if (part.bracket) return fail({{}, 0, {}, path + " is not a list", "expected a key instead of an index"});
  return table->get(part.text);
}

/// Goes down a path as far as the document holds it, but not into what is to be replaced.
Result<Slot> find_slot(toml::table& document, std::span<const Part> parts) {
  Slot slot{&document, 0};
  while (true) {
    auto next = child(*slot.container, parts[slot.depth], joined(parts.first(slot.depth)));
    if (!next) return tl::unexpected(next.error());
    if (*next == nullptr || slot.depth + 1 == parts.size()) break;
    slot = {*next, slot.depth + 1};
  }
  // Tables that are not there are made on the way, elements of lists are not.
  for (std::size_t i = slot.depth + 1; i < parts.size(); ++i) {
    if (!parts[i].bracket && !index_in(parts[i])) continue;
    const std::string path = joined(parts.first(i));
    return fail(
        {{}, 0, {}, "the scene has no list " + path, fmt::format("expected the whole of it, as {}=[...]", path)});
  }
  return slot;
}

}  // namespace

std::string source_of(const Override& override) { return kOverrideSource + override.key; }

std::optional<Error> apply_override(toml::table& document, const Override& override) {
  const auto from_here = [&](Error error) {
    error.file = source_of(override);
    error.line = 0;
    return error;
  };
  const auto parts = split(override.key);
  if (!parts) {
    return from_here({{}, 0, {}, "not a key", "expected a dotted path as solver.blast or bodies.0.mass"});
  }
  const auto slot = find_slot(document, *parts);
  if (!slot) return from_here(slot.error().front());
  const Part& part = (*parts)[slot->depth];
  auto value = document_of(std::span(*parts).subspan(slot->depth), override);
  if (!value) return from_here(value.error().front());

  // Moved, not copied: only then do nodes keep where they come from.
  value->begin()->second.visit([&](auto& node) {
    if (toml::table* table = slot->container->as_table()) {
      table->insert_or_assign(part.text, std::move(node));
    } else if (toml::array* list = slot->container->as_array()) {
      list->replace(list->begin() + static_cast<std::ptrdiff_t>(*index_in(part)), std::move(node));
    }
  });
  return std::nullopt;
}

}  // namespace divot::scene
