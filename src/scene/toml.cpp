#include "scene/toml.h"

#include <fmt/format.h>

#include "scene/visitor.h"

namespace divot::scene {

Result<toml::table> parse_toml(std::string_view text, const std::string& source) {
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& error) {
    return fail({source, static_cast<int>(error.source().begin.line), {}, std::string(error.description()), {}});
  }
}

std::string described(const toml::node& node) {
  constexpr std::size_t kMostLetters = 60;
  if (const auto* text = node.as_string()) {
    const std::string& value = text->get();
    const bool fits = value.size() <= kMostLetters;
    return quoted(fits ? std::string_view(value) : std::string_view("...")) + " is text";
  }
  if (const auto* number = node.as_floating_point()) return number_text(number->get()) + " is a number";
  if (const auto* integer = node.as_integer()) return fmt::format("{} is a number", integer->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true is a truth value" : "false is a truth value";
  if (const auto* array = node.as_array()) return fmt::format("is a list of {}", array->size());
  if (node.is_table()) return "is a table";
  return "is a date or time";
}

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (letter == '"' || letter == '\\') out += '\\';
    if (code < 0x20 || code == 0x7f) {
      out += fmt::format("\\u{:04x}", code);
    } else {
      out += letter;
    }
  }
  return out + '"';
}

}  // namespace divot::scene
