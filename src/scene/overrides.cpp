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
  const auto parsed = parse_toml("value = " + value, "");
  return parsed && parsed->size() == 1;
}

/// A document of one value at `parts`.
Result<toml::table> document_of(std::span<const Part> parts, const Override& override) {
  std::string text;
  for (const Part& part : parts) text += (text.empty() ? "" : ".") + quoted(part.text);
  text += " = " + (is_value(override.value) ? override.value : quoted(override.value));
  return parse_toml(text, source_of(override));
}

std::string size_text(std::size_t size) {
  if (size == 0) return "expected no index: the list is empty";
  return size == 1 ? "expected 0, its only element" : fmt::format("expected 0 to {}", size - 1);
}

}  // namespace

std::string source_of(const Override& override) { return "--set " + override.key; }

std::optional<Error> apply_override(toml::table& document, const Override& override) {
  const auto wrong = [&](std::string problem, std::string expected) {
    return Error{source_of(override), 0, {}, std::move(problem), std::move(expected)};
  };
  const auto split_parts = split(override.key);
  if (!split_parts) return wrong("not a key", "expected a dotted path as solver.blast or bodies.0.mass");
  const std::span<const Part> parts = *split_parts;

  // Down the path as far as the document holds it, but not into what is to be replaced.
  toml::node* at = &document;
  std::size_t depth = 0;
  for (; depth < parts.size(); ++depth) {
    const Part& part = parts[depth];
    toml::node* next = nullptr;
    if (toml::array* list = at->as_array()) {
      const auto index = index_in(part);
      if (!index)
        return wrong(fmt::format("{} is a list", joined(parts.first(depth))),
                     fmt::format("expected an index instead of {}", quoted(part.text)));
      if (*index >= list->size())
        return wrong(fmt::format("{} has no element {}", joined(parts.first(depth)), *index), size_text(list->size()));
      next = list->get(*index);
    } else if (toml::table* table = at->as_table()) {
      if (part.bracket)
        return wrong(fmt::format("{} is not a list", joined(parts.first(depth))), "expected a key instead of an index");
      next = table->get(part.text);
    } else {
      return wrong(fmt::format("{}: {}", joined(parts.first(depth)), described(*at)),
                   "expected a table or list to set a key of");
    }
    if (next == nullptr || depth + 1 == parts.size()) break;
    at = next;
  }

  // Tables that are not there are made on the way, elements of lists are not.
  for (std::size_t i = depth; i + 1 < parts.size(); ++i) {
    if (!parts[i + 1].bracket && !index_in(parts[i + 1])) continue;
    const std::string path = joined(parts.first(i + 1));
    return wrong(fmt::format("the scene has no list {}", path),
                 fmt::format("expected the whole of it, as {}=[...]", path));
  }
  auto value =
      document_of(at->is_array() ? std::span(parts).subspan(parts.size() - 1) : parts.subspan(depth), override);
  if (!value) return wrong(value.error().front().problem, {});

  // Moved, not copied: only then do nodes keep where they come from.
  value->begin()->second.visit([&](auto& node) {
    if (toml::table* table = at->as_table()) table->insert_or_assign(parts[depth].text, std::move(node));
    if (toml::array* list = at->as_array()) {
      list->replace(list->begin() + static_cast<std::ptrdiff_t>(*index_in(parts[depth])), std::move(node));
    }
  });
  return std::nullopt;
}

}  // namespace divot::scene
